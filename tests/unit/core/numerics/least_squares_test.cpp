// SPDX-License-Identifier: MIT
#include "core/numerics/least_squares.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/numerics/qr.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(LeastSquares, IsTheRegressionLine) {
  // y = 1, 3, 4 at x = 0, 1, 2: slope 3/2, intercept 7/6 (mean 8/3 at x = 1).
  Matrix a(3, 2);
  a << 1, 0, 1, 1, 1, 2;
  const Matrix h = least_squares(a, Vector{{1.0, 3.0, 4.0}});
  EXPECT_NEAR(h(0, 0), 7.0 / 6.0, 1e-14);
  EXPECT_NEAR(h(1, 0), 1.5, 1e-14);
  EXPECT_TRUE(smallest_least_squares(a, Vector{{1.0, 3.0, 4.0}}).isApprox(h, 1e-13));
}

TEST(LeastSquares, ADependentColumnGetsNothing) {
  Matrix a(2, 2);
  a << 2, 1, 4, 2;
  const Matrix h = least_squares(a, Vector{{2.0, 4.0}});
  EXPECT_NEAR(h(0, 0), 1.0, 1e-14);
  EXPECT_EQ(h(1, 0), 0.0);
}

TEST(SolveSymmetric, UndoesTheProduct) {
  // Cofactors of [4 2; 2 3] over its determinant 8.
  Matrix a(2, 2), inverse(2, 2);
  a << 4, 2, 2, 3;
  inverse << 3.0 / 8.0, -0.25, -0.25, 0.5;
  EXPECT_TRUE(solve_symmetric(a, Matrix::Identity(2, 2)).isApprox(inverse, 1e-14));
}

TEST(LeastSquares, TheSmallestSharesAmongEqualColumns) {
  const Matrix h = smallest_least_squares(Matrix::Ones(3, 2), Matrix::Constant(3, 1, 4.0));
  EXPECT_NEAR(h(0, 0), 2.0, 1e-14);
  EXPECT_NEAR(h(1, 0), 2.0, 1e-14);
}

TEST(LeastSquares, WithoutRowsAllIsZero) {
  const Matrix none = least_squares(Matrix(0, 2), Matrix(0, 3));
  EXPECT_EQ(none, Matrix::Zero(2, 3));
  EXPECT_EQ(smallest_least_squares(Matrix(0, 2), Matrix(0, 3)), none);
  EXPECT_EQ(least_squares(Matrix(3, 0), Matrix(3, 1)).rows(), 0);
}

TEST(LeastSquares, WhatIsNotFiniteHasNoSolution) {
  Matrix a = Matrix::Identity(2, 2);
  a(1, 0) = std::numeric_limits<double>::quiet_NaN();
  const Matrix b = Matrix::Ones(2, 1);
  for (const Matrix& h : {least_squares(a, b), smallest_least_squares(a, b),
                          solve_symmetric(a, b), Matrix(PivotedQr(a).solve(b))})
    EXPECT_TRUE(h.array().isNaN().all()) << h;
}

}  // namespace
}  // namespace lacuna
