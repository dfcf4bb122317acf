// SPDX-License-Identifier: MIT
#include "lacuna/hypotheses/rank.hpp"

#include <gtest/gtest.h>

#include "lacuna/effects/families.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/effect_forms.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

Ranking ranking_of(const support::Hidden& hidden) {
  const Dataset data = support::hidden_record(hidden, 0.01);
  const Assimilation base = support::assimilated(data);
  const Scope scope = make_scope(support::oscillator(), data, Vector::Constant(2, 0.01));
  return rank(data, {{}, base}, support::own_effects(), scope,
              support::oscillator_fit_options(), {}, RunContext{});
}

TEST(Rank, TheRightEffectLeadsWithItsSize) {
  const Ranking ranking = ranking_of(support::dry_friction);
  ASSERT_FALSE(ranking.effects.empty());
  const RankedEffect& best = ranking.effects.front();
  EXPECT_EQ(best.effect().candidate.effect, "dry");
  EXPECT_NEAR(best.effect().coefficient, -0.3, 0.02);
  EXPECT_GT(best.sigma, 8.0);
  EXPECT_GT(best.probability, 0.99);
  EXPECT_LT(ranking.none, 0.01);
  EXPECT_EQ(ranking.tried, 2) << "two forms in dv/dt; dq/dt = v holds exactly";
}

TEST(Rank, NothingIsRankedWhereNothingIsMissing) {
  const Ranking ranking = ranking_of(support::nothing);
  EXPECT_TRUE(ranking.effects.empty());
  EXPECT_DOUBLE_EQ(ranking.none, 1.0);
}

constexpr StageInfo kRubbing{"rubbing", "Dry friction under another name", ""};

FittedEffect named(const std::string& name, const std::string& form) {
  FittedEffect effect{support::plain_candidate(form), Vector(0), 1.0, 0.0};
  effect.candidate.effect = name;
  effect.candidate.argument = "v";
  return effect;
}

TEST(Rank, NamesOfOneTermAndFormsOfOneEffectMeanTheSame) {
  EXPECT_TRUE(have_one_term(named("stiffness", "v^3"), named("cubic", "v^3")));
  EXPECT_FALSE(have_one_term(named("stiffness", "v^3"), named("stiffness", "v^5")));
  EXPECT_TRUE(mean_the_same(named("friction", "sign(v)"), named("friction", "tanh(v/0.1)")));
  EXPECT_FALSE(mean_the_same(named("friction", "sign(v)"), named("saturation", "tanh(v)")));
  FittedEffect elsewhere = named("friction", "sign(v)");
  elsewhere.candidate.equation = 0;
  EXPECT_FALSE(mean_the_same(named("friction", "sign(v)"), elsewhere));
}

TEST(Rank, NamesOfOneTermShareItsProbability) {
  const Dataset data = support::hidden_record(support::dry_friction, 0.01);
  std::vector<Stage<Effect>> twice = support::own_effects();
  twice.push_back(support::FormEffect<kRubbing>("sign(v)"));
  const Scope scope = make_scope(support::oscillator(), data, Vector::Constant(2, 0.01));
  const Ranking ranking = rank(data, {{}, support::assimilated(data)}, twice, scope,
                               support::oscillator_fit_options(), {}, RunContext{});
  ASSERT_GE(ranking.effects.size(), 2u);
  EXPECT_GT(ranking.effects[0].probability, 0.99);
  EXPECT_DOUBLE_EQ(ranking.effects[0].probability, ranking.effects[1].probability);
  EXPECT_EQ(ranking.effects[0].criterion, ranking.effects[1].criterion) << "one fit for both";
  EXPECT_EQ(ranking.effects[0].effect().candidate.effect, "dry");
  EXPECT_EQ(ranking.effects[1].effect().candidate.effect, "rubbing");
}

/// Two bends between an arm and its drive, of which the nominal model has the slope 60.
struct Bends {
  Scope scope = support::scope_of(support::model_of_lines(
      {{"q", {{"v", 1.0}}}, {"v", {{"q", -60.0}, {"u", 60.0}}}}, {"u"}));
  std::vector<Stage<Effect>> effects{FamilyEffect<kBacklash>(), FamilyEffect<kDeadZone>(),
                                     FamilyEffect<kPiecewiseLinear>()};

  FittedEffect with(double coefficient) const {
    return {support::candidate_of<kPiecewiseLinear>(scope, 1, "clip(q-u,-edge,edge)"),
            Vector::Constant(1, 0.3), coefficient, 0.1};
  }
};

TEST(Rank, NamesAreJudgedByTheFittedNumbers) {
  const Bends bends;
  EXPECT_TRUE(is_plausible(bends.with(30.0), bends.scope.model, bends.effects, bends.scope));
  EXPECT_FALSE(is_plausible(bends.with(60.0), bends.scope.model, bends.effects, bends.scope));
}

TEST(Rank, WhatHasNoSlopeInsideIsAPlayByAnotherName) {
  const Bends bends;
  const auto other =
      other_name_of(bends.with(60.0), bends.scope.model, bends.effects, bends.scope);
  ASSERT_TRUE(other.has_value());
  EXPECT_EQ(other->effect, "backlash");
  EXPECT_FALSE(other_name_of(bends.with(60.0), bends.scope.model,
                             {FamilyEffect<kPiecewiseLinear>()}, bends.scope))
      << "there is no other name";
}

}  // namespace
}  // namespace lacuna
