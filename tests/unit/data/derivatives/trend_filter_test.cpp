// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/trend_filter.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "grids.hpp"
#include "lacuna/data/derivatives/whittaker.hpp"

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

}  // namespace
}  // namespace lacuna
