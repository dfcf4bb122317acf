// SPDX-License-Identifier: MIT
#include "data/derivatives/trend_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "core/base/random.hpp"
#include "data/derivatives/l1_trend.hpp"
#include "data/derivatives/sample_differences.hpp"
#include "data/derivatives/trend_choice.hpp"
#include "data/derivatives/whittaker.hpp"
#include "grids.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// A triangle wave of period 4: its rate is 1 or -1.
double triangle(double t) { return std::abs(std::fmod(t, 4.0) - 2.0) - 1.0; }
double slope(double t) { return std::fmod(t, 4.0) < 2.0 ? -1.0 : 1.0; }

struct Wave {
  Vector time, values, rate;
};

Wave rough_triangle(double noise, double unit = 1.0, double second = 1.0) {
  Random random(4);
  Wave wave{uniform_grid(400, 15.9), Vector(400), Vector(400)};
  for (Index i = 0; i < 400; ++i) {
    wave.values[i] = unit * (triangle(wave.time[i]) + noise * random.normal());
    wave.rate[i] = unit / second * slope(wave.time[i]);
  }
  wave.time *= second;
  return wave;
}

double rms_off(const Differentiator& method, const Wave& wave) {
  return (method.differentiate(wave.time, wave.values).col(0) - wave.rate).norm() / 20.0;
}

TEST(TrendFilter, LeavesCornersThatSquaresRoundOff) {
  const Wave wave = rough_triangle(0.02);
  const double sharp = rms_off(TrendFilter{{.order = 2}}, wave);
  const double round = rms_off(Whittaker{{.order = 2}}, wave);
  EXPECT_LT(sharp, 0.6 * round) << sharp << " " << round;
}

TEST(TrendFilter, FollowsASmoothSignal) {
  Random random(8);
  const Vector time = jittered_grid(400, 12.0);
  Vector y = time.array().cos();
  for (Index i = 0; i < y.size(); ++i) y[i] += 0.1 * random.normal();
  const Vector rate = TrendFilter{}.differentiate(time, y);
  EXPECT_LT((rate.array() + time.array().sin()).matrix().norm() / 20.0, 0.25);
}

TEST(TrendFilter, UnitsChangeUnits) {
  const Wave plain = rough_triangle(0.02), scaled = rough_triangle(0.02, 1e3, 60.0);
  const Matrix rates = TrendFilter{}.differentiate(plain.time, plain.values);
  const Matrix others = TrendFilter{}.differentiate(scaled.time, scaled.values);
  EXPECT_LT((others * 60.0 / 1e3 - rates).norm(), 1e-3 * rates.norm());
}

TEST(TrendFilter, SamplesWithoutNoiseStay) {
  const Vector time = uniform_grid(100, 3.0);
  const Vector line = 2.0 * time.array() + 1.0;
  EXPECT_LT((TrendFilter{{.lambda = 1.0}}.differentiate(time, line, 0) - line).norm(), 1e-10);
}

/// Samples that the trend of a signal with noise joins.
Index joined(const Vector& signal) {
  Random random(4);
  Dataset data;
  data.states = {{"x", ""}};
  data.trajectories = {{"", uniform_grid(400, 15.9), signal, Matrix(400, 0), Matrix()}};
  for (Index i = 0; i < 400; ++i) data.trajectories[0].states(i, 0) += 0.1 * random.normal();
  return fitted_to(TrendFilter{{.order = 2}}, data)->margin();
}

TEST(TrendFilter, MarginIsWhatIsJoined) {
  const Index corners = joined(rough_triangle(0.0).values);
  EXPECT_GT(corners, 5);
  EXPECT_LT(corners, 50);
  const Vector line = 0.3 * uniform_grid(400, 15.9);
  EXPECT_GT(joined(line), 50);
}

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

TEST(L1Trend, TwoSamplesComeNearerByTheWeight) {
  const SparseRows difference = divided_differences(Vector::LinSpaced(2, 0.0, 1.0), 1);
  const L1Trend apart = l1_trend(difference, Vector{{1.0, 5.0}}, 2.0);
  EXPECT_NEAR(apart.values[0], 2.0, 1e-6);
  EXPECT_NEAR(apart.values[1], 4.0, 1e-6);
  EXPECT_EQ(apart.knots, 1);
  const L1Trend joined = l1_trend(difference, Vector{{1.0, 5.0}}, 10.0);
  EXPECT_NEAR(joined.values[0], 3.0, 1e-6);
  EXPECT_NEAR(joined.values[1], 3.0, 1e-6);
  EXPECT_EQ(joined.knots, 0);
}

/// y - z = D'v with |v| <= weight / 2, and v at its bound, with the sign of D z, where that is
/// not 0: the conditions of a minimum, v by dense least squares.
TEST(L1Trend, HasASubgradientOfZero) {
  Random random(3);
  for (const int order : {1, 2, 3, 4})
    for (const double weight : {0.1, 1.0, 30.0}) {
      const Vector time = jittered_grid(80, 79.0);
      const SparseRows rows = divided_differences(time, order);
      Vector y = (0.1 * time.array()).sin();
      for (Index i = 0; i < y.size(); ++i) y[i] += 0.1 * random.normal();
      const L1Trend trend = l1_trend(rows, y, weight);
      const Matrix dense = Matrix(rows).transpose();
      const Vector v = dense.colPivHouseholderQr().solve(y - trend.values);
      EXPECT_LT((dense * v - (y - trend.values)).norm(), 1e-8 * y.norm()) << order;
      EXPECT_LT(v.cwiseAbs().maxCoeff(), 0.5 * weight * (1.0 + 1e-6)) << order;
      const Vector u = rows * trend.values;
      Index knots = 0;
      for (Index i = 0; i < u.size(); ++i) {
        if (std::abs(u[i]) < 1e-3 * u.cwiseAbs().maxCoeff()) continue;
        ++knots;
        EXPECT_NEAR(v[i], std::copysign(0.5 * weight, u[i]), 0.01 * weight) << order;
      }
      EXPECT_GE(trend.knots, knots) << order << " " << weight;
    }
}

}  // namespace
}  // namespace lacuna
