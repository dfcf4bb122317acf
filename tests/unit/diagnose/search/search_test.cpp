// SPDX-License-Identifier: MIT
// The search for effects, and what they are called.
#include "diagnose/search/search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/candidates/search_memory.hpp"
#include "diagnose/search/effect_names.hpp"
#include "diagnose/search/effect_size.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
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

RankedEffect ranked(const Candidate& candidate, const std::vector<std::string>& names,
                    double probability, double sigma = 5.0) {
  RankedEffect effect{
      {{{candidate, candidate.starts.front(), -1.0, 0.1}}, {.model = support::oscillator()}}};
  for (const std::string& name : names)
    effect.names.push_back({name, "sentence of " + name, "cause of " + name});
  effect.sigma = sigma;
  effect.contribution = 0.1;
  effect.probability = probability;
  return effect;
}

Ranking three_forms() {
  RankedEffect stop = ranked(support::stop_candidate(0.25), {"stop", "bend"}, 0.7);
  stop.names.front().parameters = {"gap"};
  return {{stop, ranked(support::plain_candidate("sign(v)"), {"friction"}, 0.2),
           ranked(support::plain_candidate("q^3"), {"hardening"}, 0.05)},
          0.05,
          12};
}

TEST(EffectNames, AlternativesAreOtherNamesThenOtherForms) {
  const Ranking ranking = three_forms();
  const NamedEffect named = name_effect(ranking.effects[0], ranking);
  ASSERT_EQ(named.alternatives.size(), 3u);
  EXPECT_EQ(named.alternatives[0].name, "bend");
  EXPECT_EQ(named.alternatives[0].term, "min(q-0.25,0)") << "the same form";
  EXPECT_EQ(named.alternatives[1].name, "friction");
  EXPECT_EQ(named.alternatives[1].term, "sign(v)");
  EXPECT_EQ(named.alternatives[1].probability, 0.2);
  EXPECT_EQ(named.alternatives[2].name, "hardening");
}

TEST(EffectNames, PlainerFormsAreThoseWithFewerShapesThenShallowerOnes) {
  const Ranking ranking = three_forms();
  const auto plainer = plainer_forms(ranking.effects[0], ranking, {});
  ASSERT_EQ(plainer.size(), 2u);
  EXPECT_EQ(plainer[0].named.name, "friction") << "sign(v) and q^3 have no shape: as ranked";
  EXPECT_EQ(plainer[1].named.name, "hardening");
  EXPECT_TRUE(plainer_forms(ranking.effects[1], ranking, {}).empty());
}

TEST(EffectNames, ThresholdsDecideWhichPlainerFormsCount) {
  Ranking ranking = three_forms();
  ranking.effects[1].sigma = 2.9;
  EXPECT_EQ(plainer_forms(ranking.effects[0], ranking, {}).size(), 1u);
  EXPECT_EQ(plainer_forms(ranking.effects[0], ranking, {.significance = 2.5}).size(), 2u);
  EXPECT_TRUE(plainer_forms(ranking.effects[0], ranking, {.effect_size = 0.2}).empty());
}

TEST(EffectNames, FormsElsewhereStandInAnotherPlaceAndDoAsWell) {
  Ranking ranking = three_forms();
  EXPECT_TRUE(forms_elsewhere(ranking.effects[0], ranking, {}).empty()) << "all in one place";
  ranking.effects[1].explanation.effects[0].candidate.equation = 0;
  ranking.effects[2].explanation.effects[0].candidate.place = Place::Channel;
  ranking.effects[2].criterion = 9.0;
  const auto elsewhere = forms_elsewhere(ranking.effects[0], ranking, {});
  ASSERT_EQ(elsewhere.size(), 2u);
  EXPECT_EQ(elsewhere[0].named.name, "friction");
  EXPECT_EQ(elsewhere[1].named.name, "hardening");
  EXPECT_EQ(forms_elsewhere(ranking.effects[0], ranking, {.undecided = 8.0}).size(), 1u);
}

TEST(EffectNames, FrictionThatIsWrittenAsASlopeIsToldByItsForce) {
  Candidate clip = support::plain_candidate("clip(v,-a,a)");
  clip.argument = parse_expression("v");
  clip.shapes = {{"a", "m/s", 0.001, 1.0, true}};
  const Explanation explanation{{{clip, Vector::Constant(1, 0.05), -16.0, 0.1}},
                                {.model = support::oscillator()}};
  NamedEffect friction;
  friction.name = "coulomb-friction";
  friction.parameters = {{"width", "m/s", 0.0, {}}};
  std::vector<NamedEffect> named{friction};
  for (int again = 0; again < 2; ++again) update_numbers(explanation, named);
  ASSERT_EQ(named[0].parameters.size(), 2u);
  EXPECT_EQ(named[0].parameters[1].name, "force");
  EXPECT_DOUBLE_EQ(named[0].parameters[1].value, 0.8);
  named[0].name = "piecewise-linear";
  update_numbers(explanation, named);
  EXPECT_EQ(named[0].parameters.size(), 1u) << "a slope is what it is";
}

bool counts(const EffectSize& size, const Explanation& explanation, const Explanation& after) {
  Extended before{explanation};
  return !size.shortfall(before, after);
}

std::string quantity(const EffectSize& size, const Explanation& explanation,
                     const Explanation& after) {
  Extended before{explanation};
  const auto shortfall = size.shortfall(before, after);
  return shortfall && shortfall->value < shortfall->threshold ? shortfall->quantity : "none";
}

class EffectSizes : public testing::Test {
 protected:
  /// The baseline with another fraction of the variance of its disturbance.
  Explanation leaving(double fraction) const {
    Explanation made{{{candidate_, Vector(0), 1.0, 0.1}}, base_->fitted};
    made.fit.noise.disturbance[1] *= std::sqrt(fraction);
    return made;
  }
  /// What the records are made of, brought onto them: nothing lasts in its windows.
  Assimilation complete() const {
    return explain_on(problem_, *base_, base_->fitted,
                      {{support::plain_candidate("sin(6*q)"), Vector(0), 0.0, 0.0}})
        .fit;
  }

  support::Asked asked_ = support::asked(support::ripple);
  std::shared_ptr<const Baseline> base_ = asked_.baseline();
  const Problem problem_ = asked_.problem();
  Candidate candidate_ = support::plain_candidate("q^3");
};

TEST_F(EffectSizes, IsOneForTheNominalModel) {
  const EffectSize size(problem_, *base_);
  EXPECT_DOUBLE_EQ(size.disturbance(base_->fitted, candidate_), 1.0);
  EXPECT_DOUBLE_EQ(size.gap(base_->fitted), 1.0);
  EXPECT_NEAR(size.disturbance(leaving(0.3).fit, candidate_), 0.3, 1e-12);
  Candidate measured = candidate_;
  measured.place = Place::Channel;
  measured.equation = 0;
  EXPECT_NEAR(size.disturbance(leaving(0.3).fit, measured), 0.3, 1e-12)
      << "of the only equation that is disturbed";
}

TEST_F(EffectSizes, CountsByTheFractionsThatAreAsked) {
  const EffectSize size(problem_, *base_);
  EXPECT_TRUE(counts(size, leaving(1.0), leaving(0.4))) << "most goes";
  EXPECT_EQ(quantity(size, leaving(1.0), leaving(0.95)), "fraction of the residual that goes");
  EXPECT_EQ(quantity(size, leaving(1.0), leaving(0.7)),
            "fraction of the nominal model's squared gap that goes");
  EXPECT_EQ(quantity(size, leaving(0.04), leaving(0.032)),
            "fraction of the nominal model's disturbance that goes");
  Explanation lasting = leaving(0.26);
  lasting.fit = complete();
  const Vector noise = base_->fitted.noise.disturbance;
  lasting.fit.noise.disturbance = std::sqrt(0.26) * noise;
  EXPECT_FALSE(counts(size, leaving(0.3), lasting)) << "0.04 of the disturbance are negligible";
  lasting.fit.noise.disturbance = std::sqrt(0.24) * noise;
  EXPECT_TRUE(counts(size, leaving(0.3), lasting)) << "most of what lasts goes";
  asked_.options.decision.major = 0.25;
  EXPECT_TRUE(counts(size, leaving(1.0), leaving(0.7))) << "most, if a quarter is most";
  asked_.options.decision = {.minor = 0.7};
  EXPECT_FALSE(counts(size, leaving(1.0), leaving(0.4))) << "0.6 are a minor part then";
}

TEST_F(EffectSizes, IsNearWhereNeitherDisturbanceNorGapIsNoticeablyMore) {
  const EffectSize size(problem_, *base_);
  EXPECT_TRUE(size.is_near(leaving(0.54).fit, leaving(0.5).fit, candidate_));
  EXPECT_FALSE(size.is_near(leaving(0.56).fit, leaving(0.5).fit, candidate_));
  Assimilation best = complete();
  best.noise.disturbance = base_->fitted.noise.disturbance;
  EXPECT_FALSE(size.is_near(base_->fitted, best, candidate_)) << "the gap is larger";
  EXPECT_TRUE(size.is_near(best, base_->fitted, candidate_));
}

}  // namespace
}  // namespace lacuna
