// SPDX-License-Identifier: MIT
#include "core/numerics/singular_values.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lacuna {
namespace {

/// Columns 1 and 2 of three are the same but for a factor of 2.
Matrix dependent_columns() {
  Matrix a(4, 3);
  a << 1, 2, 0, 2, 4, 1, 3, 6, -1, 0, 0, 2;
  return a;
}

TEST(SingularValues, ProductIsTheMatrix) {
  const Matrix a = dependent_columns();
  const SingularValues found = singular_values(a);
  EXPECT_TRUE((found.left * found.values.asDiagonal() * found.right.transpose()).isApprox(a));
}

TEST(SingularValues, NoRowsTellNothing) {
  const SingularValues found = singular_values(Matrix(0, 3));
  EXPECT_EQ(found.rank(0.1), 0);
  EXPECT_EQ(found.null_space(0.1), Matrix(Matrix::Identity(3, 3)));
}

TEST(SingularValues, SquaresAreThoseOfTheGramMatrix) {
  // Of [3 0; 4 5]: a'a = [25 20; 20 25] with the eigenvalues 45 and 5.
  Matrix a(2, 2);
  a << 3, 0, 4, 5;
  const SingularValues found = singular_values(a);
  EXPECT_NEAR(found.values[0] * found.values[0], 45.0, 1e-12);
  EXPECT_NEAR(found.values[1] * found.values[1], 5.0, 1e-12);
}

TEST(SingularValues, NullSpaceIsTheDependence) {
  const Matrix null = singular_values(dependent_columns()).null_space(1e-12);
  ASSERT_EQ(null.cols(), 1);
  EXPECT_NEAR(null(0, 0) / null(1, 0), -2.0, 1e-12);
  EXPECT_NEAR(null(2, 0), 0.0, 1e-12);
}

TEST(SingularValues, FewerRowsThanColumnsLeaveTheRestUndetermined) {
  const SingularValues found = singular_values(dependent_columns().topRows(1));
  EXPECT_EQ(found.rank(1e-12), 1);
  EXPECT_EQ(found.null_space(1e-12).cols(), 2);
}

TEST(SingularValues, OfNoColumnsAndOfNan) {
  const SingularValues none = singular_values(Matrix(3, 0));
  EXPECT_EQ(none.values.size(), 0);
  EXPECT_EQ(none.right.size(), 0);
  const Matrix nan = Matrix::Constant(3, 2, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(singular_values(nan).values.array().isNaN().all());
}

}  // namespace
}  // namespace lacuna
