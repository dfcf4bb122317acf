// SPDX-License-Identifier: MIT
#include "lacuna/discrepancy/rank.hpp"

#include <gtest/gtest.h>

#include "support/assimilated_oscillator.hpp"
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
  EXPECT_EQ(ranking.tried, 2);
}

TEST(Rank, NothingIsRankedWhereNothingIsMissing) {
  const Ranking ranking = ranking_of(support::nothing);
  EXPECT_TRUE(ranking.effects.empty());
  EXPECT_DOUBLE_EQ(ranking.none, 1.0);
}

}  // namespace
}  // namespace lacuna
