// SPDX-License-Identifier: MIT
#include "diagnose/criterion/holdout.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

HoldoutVerdict verdict(double before, double after, double floor) {
  return holdout_verdict({before, after, floor}, DecisionOptions{});
}

TEST(Holdout, HalfOfTheSquareAboveTheFloorHasToGo) {
  // Above the floor of 0.6 stand 1 - 0.36 = 0.64; half of it goes at after^2 = 0.68.
  EXPECT_EQ(verdict(1.0, 0.82, 0.6), HoldoutVerdict::Confirmed);
  EXPECT_EQ(verdict(1.0, 0.83, 0.6), HoldoutVerdict::Little);
}

TEST(Holdout, WhereThereIsHardlyAGapThereIsNothingToShow) {
  EXPECT_EQ(verdict(1.09, 1.08, 1.0), HoldoutVerdict::Confirmed);
  EXPECT_EQ(verdict(1.09, 1.09, 1.0), HoldoutVerdict::Little) << "nothing shrinks";
  EXPECT_EQ(verdict(1.11, 1.11, 1.0), HoldoutVerdict::Little);
}

}  // namespace
}  // namespace lacuna
