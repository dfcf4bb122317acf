// SPDX-License-Identifier: MIT
#include "lacuna/solvers/gls.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/sparse_problem.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

TEST(Gls, SolvesTheProblemWithTheCovarianceWrittenOut) {
  Random random(14);
  auto data = testing::random_rows(60, 3, 3, 0.0, random);
  double noise = 0.0;
  for (double& entry : data.y) entry += noise = 0.8 * noise + random.normal();
  const LeastSquaresSystem system = data.system();
  const Regression fit = Gls().fit(system, system.subproblem(0, system.all_terms()));
  ASSERT_TRUE(fit.converged);
  const Vector r = data.y - data.theta * fit.coefficients;
  const double rho = r.tail(59).dot(r.head(59)) / r.squaredNorm();
  Matrix covariance(60, 60);
  for (Index i = 0; i < 60; ++i)
    for (Index j = 0; j < 60; ++j)
      covariance(i, j) = std::pow(rho, static_cast<double>(std::abs(i - j)));
  const Matrix weights = covariance.inverse();
  const Vector expected = (data.theta.transpose() * weights * data.theta)
                              .ldlt()
                              .solve(data.theta.transpose() * weights * data.y);
  EXPECT_TRUE(fit.coefficients.isApprox(expected, 1e-6));
  EXPECT_GT(rho, 0.5);
  EXPECT_NEAR(fit.residual_norm, r.norm(), 1e-9);
}

TEST(Gls, IsNearerToTheTruthWhereNoiseRemembers) {
  double generalised = 0.0, ordinary = 0.0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const LeastSquaresSystem system = testing::sparse_series(300, 3.0, 0.95, seed);
    const Subproblem problem = system.subproblem(0, system.all_terms());
    const Vector truth = testing::sparse_truth();
    generalised += (Gls().fit(system, problem).coefficients - truth).squaredNorm();
    ordinary += (problem.solve() - truth).squaredNorm();
  }
  EXPECT_LT(generalised, 0.5 * ordinary);
}

}  // namespace
}  // namespace lacuna
