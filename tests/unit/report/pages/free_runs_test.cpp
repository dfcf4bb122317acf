// SPDX-License-Identifier: MIT
#include "report/pages/free_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lacuna {
namespace {

OdeModel oscillator(double stiffness) {
  const Variables variables{{"x", "v"}, {}};
  return {{{"x", ""}, {"v", ""}},
          {},
          {{{Term::parse("v", variables), 1.0}}, {{Term::parse("x", variables), -stiffness}}}};
}

/// x = cos t with noise of deviation 0.01.
Dataset noisy_cosine() {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  const Vector t = Vector::LinSpaced(1000, 0.0, 50.0);
  Matrix states(1000, 2);
  for (Index i = 0; i < 1000; ++i) {
    states(i, 0) = std::cos(t[i]) + 0.01 * normal(engine);
    states(i, 1) = -std::sin(t[i]) + 0.01 * normal(engine);
  }
  return {"s", {{"x", ""}, {"v", ""}}, {}, {{"run", t, states, Matrix(1000, 0), Matrix()}}, {}};
}

double rms_off(const GapRecord& run) {
  double sum = 0.0;
  Index count = 0;
  for (Index i = 0; i < run.time.size(); ++i)
    for (Index k = 0; k < 2; ++k)
      if (const double off = run.measured(i, k) - run.after(i, k); std::isfinite(off)) {
        sum += off * off;
        ++count;
      }
  return std::sqrt(sum / static_cast<double>(count));
}

TEST(FreeRuns, OfTheRightModelAreOffByTheNoise) {
  const auto runs = free_runs(oscillator(1.0), noisy_cosine(), Eigen::Vector2d(0.01, 0.01));
  ASSERT_EQ(runs.size(), 1u);
  // A window is about 2 pi / 0.05 samples long; the fitted state takes two of 2 x 125 values.
  EXPECT_NEAR(static_cast<double>(runs[0].length), 125.6, 20.0);
  EXPECT_NEAR(rms_off(runs[0]), 0.01, 0.0007);
  // Between the noisy samples lies the true orbit.
  for (Index i = 0; i < 500; ++i)
    EXPECT_NEAR(runs[0].after(i, 0), std::cos(runs[0].time[i]), 0.01);
}

TEST(FreeRuns, OfAWrongModelAreOffByMore) {
  const auto runs = free_runs(oscillator(1.3), noisy_cosine(), Eigen::Vector2d(0.01, 0.01));
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_GT(rms_off(runs[0]), 0.05);
}

TEST(FreeRuns, LeaveShortRecordsOut) {
  Dataset data = noisy_cosine();
  data.trajectories[0] = rows_of(data.trajectories[0], 0, 15);
  EXPECT_TRUE(free_runs(oscillator(1.0), data, Vector::Zero(2)).empty());
}

}  // namespace
}  // namespace lacuna
