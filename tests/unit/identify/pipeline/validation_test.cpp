// SPDX-License-Identifier: MIT
#include "lacuna/identify/pipeline/validation.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

double fraction_of(double error, double noise, bool seen, double motion) {
  return PredictionError{"x", error, noise, seen, motion, 100.0, 0.0}.fraction();
}

TEST(PredictionError, FractionIsBeyondTheNoise) {
  EXPECT_DOUBLE_EQ(fraction_of(5.0, 3.0, true, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(fraction_of(5.0, 4.0, true, std::sqrt(16.0 + 144.0)), 3.0 / 12.0);
  EXPECT_DOUBLE_EQ(fraction_of(2.0, 3.0, true, 5.0), 0.0);
}

TEST(PredictionError, WhatDoesNotMoveIsComparedWithItsNoise) {
  EXPECT_DOUBLE_EQ(fraction_of(5.0, 3.0, true, 3.0), 4.0 / 3.0);
}

TEST(PredictionError, NoiseThatIsNotSeenIsNotTakenOff) {
  EXPECT_DOUBLE_EQ(fraction_of(2.0, 3.0, false, 4.0), 0.5);
}

}  // namespace
}  // namespace lacuna
