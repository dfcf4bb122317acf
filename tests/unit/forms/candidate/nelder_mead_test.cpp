// SPDX-License-Identifier: MIT
#include "forms/candidate/nelder_mead.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

const SimplexSettings kLong{.reach = 0.05, .unnoticed = 0.0, .evaluations = 2000};

constexpr auto kBowl = [](const Vector& x) {
  const double a = x[0] - 0.3, b = x[1] - 0.7;
  return a * a + 10.0 * b * b + 2.0 * a * b;
};

/// Rosenbrock's valley with its least value 0 at (0.6, 0.36).
constexpr auto kValley = [](const Vector& x) {
  return std::pow(0.6 - x[0], 2) + 100.0 * std::pow(x[1] - x[0] * x[0], 2);
};

TEST(NelderMead, FindsTheLeastValueOfKnownFunctions) {
  const Vector start{{0.05, 0.1}};
  EXPECT_LT((nelder_mead(kBowl, start, kLong) - Vector{{0.3, 0.7}}).norm(), 1e-5);
  EXPECT_LT((nelder_mead(kValley, Vector{{0.3, 0.6}}, kLong) - Vector{{0.6, 0.36}}).norm(),
            1e-5);
  const auto corner = [](const Vector& x) { return std::abs(x[0] - 0.25); };
  EXPECT_NEAR(nelder_mead(corner, Vector::Constant(1, 0.9), kLong)[0], 0.25, 1e-6);
}

TEST(NelderMead, StaysInTheCubeAndFindsWhatLiesOnItsFaces) {
  double least = 1.0, most = 0.0;
  const auto slope = [&](const Vector& x) {
    least = std::min(least, x.minCoeff());
    most = std::max(most, x.maxCoeff());
    return x[0] + std::pow(x[1] - 0.5, 2) - 2.0 * x[2];
  };
  const Vector found = nelder_mead(slope, Vector{{0.4, 0.99, 1.0}}, kLong);
  EXPECT_LT((found - Vector{{0.0, 0.5, 1.0}}).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_EQ(least, 0.0);
  EXPECT_EQ(most, 1.0);
}

TEST(NelderMead, LeavesAFaceThatItHasCollapsedOnto) {
  // From near the face 1 the slope leads onto it in the first steps; the least value lies at
  // 0.2 beyond a bend.
  const auto hook = [](const Vector& x) {
    const double away = std::abs(x[1] - 0.8);
    return away > 0.02 ? 10.0 + away - 0.1 * x[0] : std::abs(x[0] - 0.2);
  };
  const Vector found = nelder_mead(hook, Vector{{0.98, 0.1}}, kLong);
  EXPECT_NEAR(found[0], 0.2, 1e-4);
  EXPECT_LT(std::abs(found[1] - 0.8), 0.021);
}

TEST(NelderMead, StepsGrowOnALongWayDown) {
  // 0.85 away by steps of 0.01 that double: 7 of them, of two evaluations each.
  const auto far = [](const Vector& x) { return std::abs(x[0] - 0.9); };
  const Vector found = nelder_mead(far, Vector::Constant(1, 0.05),
                                   {.reach = 0.01, .unnoticed = 0.0, .evaluations = 24});
  EXPECT_NEAR(found[0], 0.9, 0.1);
}

TEST(NelderMead, EndsAfterAboutSoManyEvaluationsOrWhenNothingChanges) {
  int count = 0;
  const auto counted = [&](const Vector& x) {
    ++count;
    return kValley(x);
  };
  nelder_mead(counted, Vector{{0.05, 0.1}}, {.reach = 0.05, .evaluations = 30});
  EXPECT_GE(count, 30);
  EXPECT_LE(count, 34) << "the last step takes four at most: reflected, contracted, shrunk";
  count = 0;
  nelder_mead(counted, Vector{{0.05, 0.1}}, {.reach = 0.05, .unnoticed = 1e3});
  EXPECT_EQ(count, 3) << "the first simplex";
}

TEST(NelderMead, IsNeverWorseThanItsStart) {
  const auto ragged = [](const Vector& x) { return std::sin(40.0 * x[0]) + x[0]; };
  for (double start = 0.0; start <= 1.0; start += 0.125) {
    const Vector found = nelder_mead(ragged, Vector::Constant(1, start), kLong);
    EXPECT_LE(ragged(found), ragged(Vector::Constant(1, start)));
  }
}

}  // namespace
}  // namespace lacuna
