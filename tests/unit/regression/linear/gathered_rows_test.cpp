// SPDX-License-Identifier: MIT
#include "regression/linear/gathered_rows.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "lacuna/regression/linear/subproblem.hpp"

namespace lacuna {
namespace {

TEST(GatheredRows, AreTheRowsOfTheSystem) {
  Random random(1);
  Matrix theta(30, 3), y(30, 2);
  for (double& entry : theta.reshaped()) entry = random.normal();
  for (double& entry : y.reshaped()) entry = random.normal();
  theta.col(2) *= 1e6;
  const LeastSquaresSystem system(make_row_source(theta, y), {"a", "b", "c"}, {"u", "v"});
  const Matrix rows = gathered_rows(system, 1, {0, 2}, {});
  EXPECT_TRUE(rows.col(0).isApprox(theta.col(0), 1e-12));
  EXPECT_TRUE(rows.col(1).isApprox(theta.col(2), 1e-12));
  EXPECT_TRUE(rows.col(2).isApprox(y.col(1), 1e-12));
}

TEST(RowTriangle, HasTheSameGram) {
  const Matrix rows = Matrix::Random(9, 4);
  const Matrix r = row_triangle(rows);
  EXPECT_EQ(r.rows(), 4);
  EXPECT_TRUE((r.transpose() * r).isApprox(rows.transpose() * rows, 1e-12));
  EXPECT_EQ(row_triangle(rows.topRows(3)), rows.topRows(3));
}

TEST(FactorOfRows, IsThatOfTheSystem) {
  const Matrix rows = Matrix::Random(40, 4);
  const LeastSquaresSystem system(make_row_source(rows.leftCols(3), rows.rightCols(1)),
                                  {"a", "b", "c"}, {"y"});
  const Factor factor = factor_of_rows(rows, 40);
  EXPECT_TRUE(factor.column_norms.isApprox(system.factor().column_norms, 1e-12));
  EXPECT_TRUE(Subproblem(factor, 0, {0, 2})
                  .solve()
                  .isApprox(system.subproblem(0, {0, 2}).solve(), 1e-10));
}

}  // namespace
}  // namespace lacuna
