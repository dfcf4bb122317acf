// SPDX-License-Identifier: MIT
#include "trajectories/windows/windows.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

/// Errors that grow by a factor in each interval, one state.
ErrorGrowth constant_growth(Index samples, double factor) {
  return {Matrix::Constant(samples, 1, factor), 1};
}

Index covered(const WindowPlan& plan) {
  Index sum = 0;
  for (const Window& window : plan) {
    EXPECT_EQ(window.first, sum);
    sum += window.samples;
  }
  return sum;
}

TEST(Windows, EndWhereErrorsHaveGrown) {
  WindowLimits limits{.growth = 3.0, .turn = 1e9, .shortest = 2, .longest = 1000};
  const WindowPlan plan = plan_windows({0, 100}, constant_growth(100, std::exp(0.1)), limits);
  EXPECT_EQ(covered(plan), 100);
  EXPECT_EQ(plan.front().samples, 11);  // exp(0.1 * 10) < 3 < exp(0.1 * 11)
  EXPECT_EQ(plan.front().intervals, 11);
  EXPECT_EQ(plan.back().intervals, plan.back().samples - 1);
}

TEST(Windows, TurningStatesEndWindowsWithoutGrowth) {
  ErrorGrowth rotation{Matrix(50, 4), 2};
  const double angle = 0.5;
  for (Index i = 0; i < 50; ++i)
    rotation.transitions.row(i) << std::cos(angle), std::sin(angle), -std::sin(angle),
        std::cos(angle);
  WindowLimits limits{.growth = 3.0, .turn = 6.3, .shortest = 2, .longest = 1000};
  const WindowPlan plan = plan_windows({0, 50}, rotation, limits);
  EXPECT_EQ(plan.front().samples, 13);  // 6.3 / (2 sin(angle / 2) is 12.7 intervals
  EXPECT_NEAR(largest_growth(plan, rotation), 1.0, 1e-12);
}

TEST(Windows, NeverCrossTrajectories) {
  const WindowPlan plan = equal_windows({0, 25, 40}, 10);
  EXPECT_EQ(covered(plan), 40);
  for (const Window& window : plan)
    EXPECT_TRUE(window.first >= 25 || window.first + window.samples <= 25);
}

}  // namespace
}  // namespace lacuna
