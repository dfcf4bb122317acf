// SPDX-License-Identifier: MIT
#include "forms/candidate/nelder_mead.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// Rosenbrock's valley with its least value 0 at (0.6, 0.36).
constexpr auto kValley = [](const Vector& x) {
  return std::pow(0.6 - x[0], 2) + 100.0 * std::pow(x[1] - x[0] * x[0], 2);
};

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

}  // namespace
}  // namespace lacuna
