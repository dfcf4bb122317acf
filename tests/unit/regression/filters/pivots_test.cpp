// SPDX-License-Identifier: MIT
#include "regression/filters/pivots.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

TEST(Pivots, AreTheFirstOfColumnsThatServeAlike) {
  const double h = std::sqrt(0.5);
  Matrix rows(2, 4);
  rows << h, 0.0, h, 0.0,  //
      0.0, 0.0, 0.0, 1.0;
  EXPECT_EQ(pivots(rows), (TermSet{0, 3}));
}

TEST(Pivots, AColumnOfLessThanHalfTheLargestNormWaits) {
  const Matrix row = Vector{{0.4, 0.6, std::sqrt(1.0 - 0.52)}}.transpose();
  EXPECT_EQ(pivots(row), (TermSet{0}));  // 0.4 is more than half of 0.69
  const Matrix other = Vector{{0.3, 0.6, std::sqrt(1.0 - 0.45)}}.transpose();
  EXPECT_EQ(pivots(other), (TermSet{1}));
}

TEST(Pivots, OfNothingAreNone) { EXPECT_TRUE(pivots(Matrix(0, 3)).empty()); }

}  // namespace
}  // namespace lacuna
