// SPDX-License-Identifier: MIT
#include "core/numerics/constrained_least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "support/random_matrix.hpp"

namespace lacuna {
namespace {

using testing::random_matrix;

TEST(ConstrainedLeastSquares, SolvesTheEquationsOfLagrange) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Matrix r = random_matrix(12, 6, seed);
    r.col(2) *= 1e6;  // columns of any size
    r.col(4) *= 1e-5;
    const Vector c = random_matrix(12, 1, seed + 100);
    const Matrix a = random_matrix(2, 6, seed + 200);
    const Vector b = random_matrix(2, 1, seed + 300);
    const ConstrainedSolution found = constrained_least_squares(r, c, a, b);
    // [R'R A'; A 0] [h; l] = [R'c; b], in columns of unit length
    const Vector scale = r.colwise().norm().cwiseInverse();
    Matrix system = Matrix::Zero(8, 8);
    system.topLeftCorner(6, 6) =
        scale.asDiagonal() * (r.transpose() * r).eval() * scale.asDiagonal();
    system.topRightCorner(6, 2) = scale.asDiagonal() * a.transpose();
    system.bottomLeftCorner(2, 6) = a * scale.asDiagonal();
    Vector right(8);
    right << scale.asDiagonal() * (r.transpose() * c).eval(), b;
    const Matrix inverse = system.fullPivLu().inverse();
    const Vector h = (inverse * right).head(6).cwiseProduct(scale);
    for (Index i = 0; i < 6; ++i) {
      EXPECT_NEAR(found.h[i], h[i], 1e-7 * (std::abs(h[i]) + scale[i]));
      EXPECT_NEAR(found.variances[i], inverse(i, i) * scale[i] * scale[i],
                  1e-7 * scale[i] * scale[i]);
    }
    EXPECT_LT((a * found.h - b).norm(), 1e-9 * (1.0 + found.h.norm() * a.norm()));
  }
}

TEST(ConstrainedLeastSquares, AFixedCoefficientHasNoVariance) {
  const Matrix r = random_matrix(9, 3, 1);
  Matrix a = Matrix::Zero(1, 3);
  a(0, 1) = 1.0;
  const ConstrainedSolution found =
      constrained_least_squares(r, random_matrix(9, 1, 2), a, Vector::Constant(1, 2.5));
  EXPECT_NEAR(found.h[1], 2.5, 1e-14);
  EXPECT_NEAR(found.variances[1], 0.0, 1e-28);
  EXPECT_GT(found.variances[0], 0.0);
}

TEST(ConstrainedLeastSquares, RepeatedConstraintsAreOne) {
  const Matrix r = random_matrix(9, 3, 3);
  const Vector c = random_matrix(9, 1, 4);
  Matrix once = Matrix::Zero(1, 3), twice = Matrix::Zero(2, 3);
  once.row(0) << 1.0, 1.0, 0.0;
  twice.rowwise() = once.row(0);
  EXPECT_LT((constrained_least_squares(r, c, once, Vector::Zero(1)).h -
             constrained_least_squares(r, c, twice, Vector::Zero(2)).h)
                .norm(),
            1e-12);
}

TEST(ConstrainedLeastSquares, WhatTheRowsDoNotTellHasNoFiniteVariance) {
  Matrix r = random_matrix(9, 4, 5);
  r.col(3) = r.col(2);
  Matrix a = Matrix::Zero(1, 4);
  a(0, 0) = 1.0;
  const ConstrainedSolution found =
      constrained_least_squares(r, random_matrix(9, 1, 6), a, Vector::Constant(1, 1.0));
  EXPECT_TRUE(found.h.allFinite());
  EXPECT_TRUE(std::isfinite(found.variances[0]) && std::isfinite(found.variances[1]));
  EXPECT_TRUE(std::isinf(found.variances[2]) && std::isinf(found.variances[3]));
}

TEST(ConstrainedLeastSquares, ContradictionsAreSeen) {
  Matrix a(2, 2);
  a << 1.0, 1.0, 2.0, 2.0;
  EXPECT_TRUE(is_feasible(a, Vector{{1.0, 2.0}}));
  EXPECT_FALSE(is_feasible(a, Vector{{1.0, 3.0}}));
  EXPECT_TRUE(is_feasible(Matrix(0, 2), Vector(0)));
  EXPECT_THROW(constrained_least_squares(a, Vector::Zero(3), a, Vector::Zero(2)),
               ArgumentError);
}

TEST(ConstrainedLeastSquares, FeasibleShapesHaveToFit) {
  EXPECT_THROW(is_feasible(Matrix::Ones(2, 3), Vector::Ones(3)), ArgumentError);
  EXPECT_FALSE(is_feasible(Matrix::Constant(1, 1, NAN), Vector::Ones(1)));
}

}  // namespace
}  // namespace lacuna
