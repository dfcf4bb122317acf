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

TEST(Ridge, ThePenaltyIsThatOfTheResidual) {
  Random random(7);
  const auto data = testing::random_rows(40, 5, 3, 0.3, random);
  const LeastSquaresSystem system = data.system();
  const Subproblem problem = system.subproblem(0, system.all_terms());
  const Vector h = data.theta.colPivHouseholderQr().solve(data.y);
  const Vector norms = data.theta.colwise().norm();
  const double noise = (data.y - data.theta * h).squaredNorm() / 35.0;
  const double alpha = 5.0 * noise / h.cwiseProduct(norms).squaredNorm();
  EXPECT_TRUE(Ridge().fit(system, problem).coefficients.isApprox(
      Ridge({.alpha = alpha}).fit(system, problem).coefficients, 1e-9));
}

/// Columns that are alike, as those of whitened rows: a penalty that does not follow the noise
/// moves coefficients by many of their errors.
TEST(Ridge, BiasStaysBelowTheScatterOfManyRows) {
  for (const double noise : {0.0, 1e-5, 1e-3}) {
    Random random(8);
    auto data = testing::random_rows(20000, 3, 0, 0.0, random);
    data.theta.col(1) = data.theta.col(0) + 1e-3 * data.theta.col(2);
    data.y = data.theta.col(0) - data.theta.col(1) + 0.5 * data.theta.col(2);
    for (double& entry : data.y) entry += noise * random.normal();
    const LeastSquaresSystem system = data.system();
    const Subproblem problem = system.subproblem(0, {0, 1});
    const Vector plain = problem.solve();
    const Vector error =
        noise * problem.inverse_gram_diagonal().cwiseSqrt() + 1e-3 * plain.cwiseAbs();
    const Vector off = Ridge().fit(system, problem).coefficients - plain;
    EXPECT_TRUE((off.array().abs() < 3.0 * error.array()).all()) << off.transpose();
  }
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
