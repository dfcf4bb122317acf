// SPDX-License-Identifier: MIT
#include "diagnose/search/search.hpp"

#include <gtest/gtest.h>

#include "diagnose/candidates/search_memory.hpp"
#include "support/asked.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

double dry(double, double, double v) { return -0.3 * (v > 0.0 ? 1.0 : -1.0); }
double dry_and_cubic(double t, double q, double v) { return dry(t, q, v) - 1.2 * q * q * q; }

class Search : public testing::Test {
 protected:
  FoundEffects found(const support::Hidden& hidden, const DecisionOptions& decision = {}) {
    asked_ = support::asked(hidden, 0.01, support::own_effects());
    asked_.options.decision = decision;
    base_ = asked_.baseline();
    const Problem problem = asked_.problem();
    return search_effects({problem, *base_, asked_.options.effects});
  }

  support::Asked asked_;
  std::shared_ptr<const Baseline> base_;
};

TEST_F(Search, FindsEffectsOneAfterAnother) {
  const FoundEffects effects = found(dry_and_cubic);
  ASSERT_EQ(effects.named.size(), 2u);
  ASSERT_EQ(effects.explanation.effects.size(), 2u);
  for (const NamedEffect& named : effects.named) {
    EXPECT_NEAR(named.coefficient, named.name == "dry" ? -0.3 : -1.2, 4.0 * named.deviation);
    EXPECT_EQ(named.term, named.name == "dry" ? "sign(v)" : "q^3");
  }
  EXPECT_NE(effects.named[0].name, effects.named[1].name);
  EXPECT_TRUE(effects.left.empty() || effects.left[0].sigma < 3.0);
  ASSERT_GE(effects.rounds.size(), 2u);
  EXPECT_TRUE(effects.rounds[0].accepted && effects.rounds[1].accepted);
}

TEST_F(Search, WhatOthersHaveFittedChangesNothing) {
  const FoundEffects first = found(dry_and_cubic);
  Problem problem = asked_.problem();
  problem.memory = std::shared_ptr<SearchMemory>(new SearchMemory{.fits = FitMemory(0)});
  const FoundEffects alone = search_effects({problem, *base_, asked_.options.effects});
  problem.memory = std::make_shared<SearchMemory>();
  for (int time = 0; time < 2; ++time) {
    const FoundEffects again = search_effects({problem, *base_, asked_.options.effects});
    EXPECT_EQ(again.explanation.fit.deviance, alone.explanation.fit.deviance);
    ASSERT_EQ(again.named.size(), first.named.size());
    for (std::size_t e = 0; e < again.named.size(); ++e)
      EXPECT_EQ(again.named[e].coefficient, alone.named[e].coefficient);
  }
}

TEST_F(Search, EndsWhereMoreParametersDoNotCount) {
  found(dry_and_cubic);
  Problem problem = asked_.problem();
  const auto rounds_of = [&](Index most_parameters) {
    problem.most_parameters = most_parameters;
    return search_effects({problem, *base_, asked_.options.effects}).rounds.size();
  };
  EXPECT_EQ(rounds_of(0), 0u);
  EXPECT_EQ(rounds_of(1), 1u);
}

TEST_F(Search, GoesWithoutFormsThatAreShutOut) {
  found(dry_and_cubic);
  const Problem problem = asked_.problem();
  EffectSearch search{problem, *base_, asked_.options.effects};
  Candidate dry = support::own_effects()[0]->candidates(base_->scope, 1).front();
  search.without = {dry};
  for (const NamedEffect& named : search_effects(search).named) EXPECT_EQ(named.name, "cubic");
  dry.families = {"another"};
  search.without = {dry};
  EXPECT_EQ(search_effects(search).named.size(), 2u) << "it is not one of this effect's";
}

TEST_F(Search, RivalsElsewhereDoAsWellInTheEnd) {
  FoundEffects effects = found(dry);
  const Problem problem = asked_.problem();
  const EffectSearch search{problem, *base_, asked_.options.effects};
  ASSERT_EQ(effects.elsewhere.size(), effects.named.size());
  EXPECT_TRUE(rivals_elsewhere(search, effects).empty());
  OtherForm cube{effects.named[0], effects.explanation.effects[0]};
  cube.effect.candidate = support::own_effects()[1]->candidates(base_->scope, 1).front();
  cube.named.name = "cubic";
  effects.elsewhere[0] = {cube};
  EXPECT_TRUE(rivals_elsewhere(search, effects).empty()) << "it does much worse";
  asked_.options.decision.undecided = 1e6;
  const auto rivals = rivals_elsewhere(search, effects);
  ASSERT_EQ(rivals.size(), 1u);
  EXPECT_EQ(rivals[0].sentence,
            "in the place of dry the records allow as well cubic (q^3) in dv/dt; coefficients "
            "that are known (--tolerance) may decide");
}

TEST_F(Search, AThresholdThatIsNotReachedStandsInTheTrail) {
  const FoundEffects few = found(dry, {.significance = 1e3});
  EXPECT_TRUE(few.named.empty());
  ASSERT_FALSE(few.rivals.empty());
  EXPECT_EQ(few.rivals[0].quantity, "significance");
  EXPECT_LT(few.rivals[0].value, 1e3);
  EXPECT_EQ(few.rivals[0].threshold, 1e3);
  const FoundEffects small = found(dry, {.effect_size = 0.9});
  EXPECT_TRUE(small.named.empty());
  ASSERT_FALSE(small.rivals.empty());
  EXPECT_EQ(small.rivals[0].quantity, "effect size");
  EXPECT_FALSE(small.rivals[0].taken);
}

}  // namespace
}  // namespace lacuna
