// SPDX-License-Identifier: MIT
#include "core/numerics/coordinate_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

const Matrix kGram{{1.0, 0.5, 0.0}, {0.5, 1.0, 0.0}, {0.0, 0.0, 0.0}};
const Vector kCorrelation{{1.0, 0.8, 0.0}};

Vector swept(const Vector& first, double second) {
  Vector z = Vector::Zero(3), slope = kCorrelation;
  for (int i = 0; i < 100; ++i) coordinate_sweep(kGram, {first, second}, z, slope);
  return z;
}

TEST(CoordinateSweep, WithoutPenaltyIsLeastSquares) {
  const Vector z = swept(Vector::Zero(3), 0.0);
  EXPECT_NEAR(z[0] + 0.5 * z[1], 1.0, 1e-14);
  EXPECT_NEAR(0.5 * z[0] + z[1], 0.8, 1e-14);
  EXPECT_EQ(z[2], 0.0) << "a column of zeros";
}

/// At the minimum 2 R'(c - R z)_j = first_j sign(z_j) + second z_j, or |2 R'(c - R z)_j| is
/// less.
TEST(CoordinateSweep, EndsAtTheMinimumOfBothPenalties) {
  const Vector first{{0.2, 1.2, 0.1}};
  const double second = 0.3;
  const Vector z = swept(first, second);
  const Vector slope = 2.0 * (kCorrelation - kGram * z);
  EXPECT_NEAR(slope[0], first[0] + second * z[0], 1e-14);
  EXPECT_EQ(z[1], 0.0);
  EXPECT_LE(std::abs(slope[1]), first[1]);
}

TEST(CoordinateSweep, KeepsTheSlopeUpToDate) {
  Vector z = Vector::Zero(3), slope = kCorrelation;
  const Vector none = Vector::Zero(3);
  EXPECT_DOUBLE_EQ(coordinate_sweep(kGram, {none}, z, slope), 1.0);
  EXPECT_LT((slope - (kCorrelation - kGram * z)).norm(), 1e-15);
}

}  // namespace
}  // namespace lacuna
