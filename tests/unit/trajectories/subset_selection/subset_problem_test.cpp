// SPDX-License-Identifier: MIT
#include "trajectories/subset_selection/subset_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "lacuna/core/base/error.hpp"
#include "support/correlated_rows.hpp"

namespace lacuna {
namespace {

TEST(SubsetProblem, LossIsTheGainOfTakingItBack) {
  const SubsetProblem problem = subset_problem(triangle_of(correlated_rows(1.0)));
  const Vector losses = losses_of(fit_subset(problem, {1, 4, 9}));
  EXPECT_NEAR(losses[1], gains_of(problem, {1, 9})[4], 1e-6 * losses[1]);
  EXPECT_NEAR(losses[1],
              fit_subset(problem, {1, 9}).residual - fit_subset(problem, {1, 4, 9}).residual,
              1e-6 * losses[1]);
}

TEST(SubsetProblem, VarianceIsThatOfLeastSquares) {
  const Matrix rows = correlated_rows(1.0);
  Matrix chosen(400, 2);
  chosen << rows.col(1), rows.col(4);
  const Matrix expected = (chosen.transpose() * chosen).inverse();
  const Vector variances = variances_of(subset_problem(triangle_of(rows)), {1, 4});
  EXPECT_NEAR(variances[0], expected(0, 0), 1e-9 * expected(0, 0));
}

TEST(SubsetProblem, CoefficientsAreThoseOfTheRows) {
  const Matrix rows = correlated_rows(1.0);
  Matrix chosen(400, 2);
  chosen << rows.col(9), rows.col(4);
  const Vector expected = chosen.colPivHouseholderQr().solve(rows.col(12));
  const SubsetProblem problem = subset_problem(triangle_of(rows));
  EXPECT_TRUE(solution_of(problem, {9, 4}).isApprox(expected, 1e-9));
  const double left = (rows.col(12) - chosen * expected).squaredNorm();
  EXPECT_NEAR(fit_subset(problem, {9, 4}).residual, left, 1e-9 * left);
}

}  // namespace
}  // namespace lacuna
