// SPDX-License-Identifier: MIT
#include "lacuna/solvers/ridge.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

TEST(Ridge, MinimisesThePenalisedSquares) {
  Random random(6);
  const auto data = testing::random_rows(40, 5, 3, 0.3, random);
  const LeastSquaresSystem system = data.system();
  const Regression fit =
      Ridge({.alpha = 0.2}).fit(system, system.subproblem(0, system.all_terms()));
  const Vector squares = data.theta.colwise().squaredNorm();
  Matrix normal = data.theta.transpose() * data.theta;
  normal.diagonal() += 0.2 * squares;
  const Vector expected = normal.ldlt().solve(data.theta.transpose() * data.y);
  EXPECT_TRUE(fit.coefficients.isApprox(expected, 1e-10));
  EXPECT_NEAR(fit.residual_norm, (data.y - data.theta * expected).norm(), 1e-9);
  EXPECT_TRUE(fit.removed.empty());
}

TEST(Ridge, AColumnOfZerosGetsNothing) {
  Random random(6);
  auto data = testing::random_rows(40, 3, 2, 0.3, random);
  data.theta.col(1).setZero();
  const LeastSquaresSystem system = data.system();
  const Regression fit = Ridge().fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_EQ(fit.coefficients[1], 0.0);
  EXPECT_TRUE(fit.coefficients.allFinite());
}

}  // namespace
}  // namespace lacuna
