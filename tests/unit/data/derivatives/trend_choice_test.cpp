// SPDX-License-Identifier: MIT
#include "data/derivatives/trend_choice.hpp"

#include <gtest/gtest.h>

#include "data/derivatives/l1_trend.hpp"
#include "grids.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(TrendChoice, DifferencesHaveNoUnitOfTime) {
  const Vector time = jittered_grid(30, 2.9);
  const ScaledDifferences plain = scaled_differences(time, 2),
                          slow = scaled_differences(60.0 * time, 2);
  EXPECT_NEAR(plain.step, 0.1, 1e-12);
  EXPECT_LT((Matrix(plain.rows) - Matrix(slow.rows)).norm(), 1e-9);
  EXPECT_NEAR(plain.rows.row(0).sum(), 0.0, 1e-9);
}

/// Levels of 50 samples.
Vector stairs(double noise) {
  Random random(2);
  Vector values(400);
  for (Index i = 0; i < values.size(); ++i)
    values[i] = static_cast<double>(i / 50 % 3) + noise * random.normal();
  return values;
}

TEST(TrendChoice, LevelsAreFoundWithTheirJumps) {
  const Vector truth = stairs(0.0), values = stairs(0.1);
  const SparseRows rows = scaled_differences(uniform_grid(400, 1.0), 1).rows;
  const TrendChoice chosen = choose_trend(rows, values, Vector::Constant(1, 0.1));
  const L1Trend trend = l1_trend(rows, values, 0.1 * chosen.weight);
  EXPECT_LT((trend.values - truth).norm(), 0.5 * (values - truth).norm());
  EXPECT_GE(trend.knots, 7);
  EXPECT_LT(trend.knots, 40);
  const double rss = (values - trend.values).squaredNorm() / 0.01;
  EXPECT_LE(chosen.score, rss + 2.0 * static_cast<double>(trend.knots + 1) + 1e-6);
}

TEST(TrendChoice, ColumnsWithoutNoiseDoNotCount) {
  const SparseRows rows = scaled_differences(uniform_grid(400, 1.0), 1).rows;
  Matrix both(400, 2);
  both << stairs(0.1), stairs(0.0);
  const TrendChoice one = choose_trend(rows, stairs(0.1), Vector{{0.1}}),
                    two = choose_trend(rows, both, Vector{{0.1, 0.0}});
  EXPECT_EQ(one.weight, two.weight);
  EXPECT_EQ(one.score, two.score);
}

TEST(TrendChoice, JoinedSamplesGrowWithTheWeight) {
  EXPECT_DOUBLE_EQ(joined_samples(2.0, 1), 1.0);
  EXPECT_DOUBLE_EQ(joined_samples(2.0 * 8.0, 2), 4.0);
  EXPECT_THROW(choose_trend(scaled_differences(uniform_grid(10, 1.0), 1).rows, Vector::Ones(9),
                            Vector::Ones(1)),
               ArgumentError);
}

}  // namespace
}  // namespace lacuna
