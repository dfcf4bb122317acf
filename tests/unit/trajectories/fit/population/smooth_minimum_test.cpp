// SPDX-License-Identifier: MIT
#include "trajectories/fit/population/smooth_minimum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lacuna {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

SmoothTask from(const Vector& start) {
  return {start, Matrix::Identity(start.size(), start.size()),
          Vector::Constant(start.size(), -kNone), Vector::Constant(start.size(), kNone)};
}

// Rosenbrock's valley (Computer J. 3:175-184, 1960): its minimum is (1, 1).
const auto valley = [](const Vector& x) {
  return std::pow(1.0 - x[0], 2) + 100.0 * std::pow(x[1] - x[0] * x[0], 2);
};

TEST(SmoothMinimum, FollowsACurvedValley) {
  int moves = 0;
  const SmoothMinimum found = minimise_smooth(
      valley, [&](const Vector&) { ++moves; }, from(Vector{{-1.2, 1.0}}), {});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.place[0], 1.0, 1e-3);
  EXPECT_NEAR(found.place[1], 1.0, 1e-3);
  EXPECT_LT(found.value, 1e-6);
  EXPECT_GT(moves, 5);
}

TEST(SmoothMinimum, StaysInRangesAndAtWhatIsHeld) {
  SmoothTask task = from(Vector{{0.2, 0.0, 5.0}});
  task.upper[0] = 0.5;
  task.lower[2] = task.upper[2] = 5.0;
  const SmoothMinimum found = minimise_smooth(
      [](const Vector& x) { return valley(x.head(2)) + std::pow(x[2], 2); },
      [](const Vector&) {}, task, {});
  EXPECT_TRUE(found.converged);
  EXPECT_DOUBLE_EQ(found.place[0], 0.5);
  EXPECT_NEAR(found.place[1], 0.25, 1e-4) << "least of the valley at x = 0.5";
  EXPECT_DOUBLE_EQ(found.place[2], 5.0);
}

TEST(SmoothMinimum, ComesBackFromWhereThereIsNoValue) {
  // -log x + x has its minimum at 1; beyond 0 it has no value.
  const SmoothMinimum found = minimise_smooth(
      [](const Vector& x) { return x[0] > 0.0 ? x[0] - std::log(x[0]) : kNone; },
      [](const Vector&) {}, from(Vector{{6.0}}), {});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.place[0], 1.0, 1e-3);
}

TEST(SmoothMinimum, SecondDerivativesOfAQuadraticAreExact) {
  const Matrix expected{{4.0, 1.0, 0.0}, {1.0, 3.0, 0.0}, {0.0, 0.0, 0.0}};
  const Matrix found = second_derivatives(
      [&](const Vector& x) { return 0.5 * x.dot(expected * x) + 2.0 * x[0] + x[2] * x[2]; },
      Vector{{0.3, -0.2, 1.0}}, Vector{{0.1, 0.2, 0.0}}, {});
  EXPECT_TRUE(found.isApprox(expected, 1e-10)) << found;
}

}  // namespace
}  // namespace lacuna
