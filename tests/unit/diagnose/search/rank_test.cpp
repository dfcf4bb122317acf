// SPDX-License-Identifier: MIT
#include "diagnose/search/rank.hpp"

#include <gtest/gtest.h>

#include "lacuna/effects/families.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/effect_forms.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

/// The first ranking of a record with something hidden in it.
Ranking ranking_of(const support::Hidden& hidden, const std::vector<Stage<Effect>>& effects) {
  const OdeModel nominal = support::oscillator();
  const BoundRecords records = observed(support::hidden_record(hidden, 0.01));
  const DiagnosisOptions options;
  const RunContext context;
  const Problem problem{nominal, records, options, context};
  const Baseline base = plain_baseline(problem);
  return rank({problem, base, effects}, {{}, base.fitted});
}

TEST(Rank, TheRightEffectLeadsWithItsSize) {
  const Ranking ranking = ranking_of(support::dry_friction, support::own_effects());
  ASSERT_FALSE(ranking.effects.empty());
  const RankedEffect& best = ranking.effects.front();
  ASSERT_FALSE(best.names.empty());
  EXPECT_EQ(best.names.front().name, "dry");
  EXPECT_NEAR(best.effect().coefficient, -0.3, 0.02);
  EXPECT_GT(best.sigma, 8.0);
  EXPECT_GT(best.probability, 0.99);
  EXPECT_LT(ranking.none, 0.01);
  EXPECT_EQ(ranking.tried, 2) << "two forms in dv/dt; dq/dt = v holds exactly";
}

TEST(Rank, NothingIsRankedWhereNothingIsMissing) {
  const Ranking ranking = ranking_of(support::nothing, support::own_effects());
  EXPECT_TRUE(ranking.effects.empty());
  EXPECT_DOUBLE_EQ(ranking.none, 1.0);
}

constexpr StageInfo kRubbing{"rubbing", "Dry friction under another name", ""};

TEST(Rank, NamesOfOneTermShareItsFit) {
  std::vector<Stage<Effect>> twice = support::own_effects();
  twice.push_back(support::FormEffect<kRubbing>("sign(v)"));
  const Ranking ranking = ranking_of(support::dry_friction, twice);
  ASSERT_GE(ranking.effects.size(), 1u);
  EXPECT_GT(ranking.effects[0].probability, 0.99);
  ASSERT_EQ(ranking.effects[0].names.size(), 2u);
  EXPECT_EQ(ranking.effects[0].names[0].name, "dry");
  EXPECT_EQ(ranking.effects[0].names[1].name, "rubbing");
  EXPECT_EQ(ranking.tried, 2) << "the form is tried once";
}

FittedEffect fitted(const Candidate& candidate) {
  return {candidate, candidate.starts.front(), -1.0, 0.01};
}

TEST(Rank, FormsOfOneEffectHaveOneNameOrNest) {
  const Scope scope = support::oscillator_scope();
  const FittedEffect sharp =
      fitted(support::candidate_of<kCoulombFriction>(scope, 1, "sign(v)"));
  const FittedEffect rising = fitted(
      support::candidate_of<kStribeckFriction>(scope, 1, "(1+rise*exp(-(v/speed)^2))*sign(v)"));
  const FittedEffect drag = fitted(support::candidate_of<kQuadraticDrag>(scope, 1, "v*abs(v)"));
  EXPECT_TRUE(are_forms_of_one(sharp, "friction", rising, "rising friction", scope));
  EXPECT_FALSE(are_forms_of_one(sharp, "friction", drag, "drag", scope));
  EXPECT_TRUE(are_forms_of_one(sharp, "friction", drag, "friction", scope));
  FittedEffect elsewhere = sharp;
  elsewhere.candidate.equation = 0;
  EXPECT_FALSE(are_forms_of_one(sharp, "friction", elsewhere, "friction", scope));
}

}  // namespace
}  // namespace lacuna
