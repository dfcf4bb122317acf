// SPDX-License-Identifier: MIT
#include "lacuna/solvers/elastic_net.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "support/sparse_problem.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

TEST(ElasticNet, OrthonormalColumnsAreThresholdedAndShrunk) {
  // min (c - z)^2 + l1 |z| + l2/2 z^2 has z = soft(c, l1/2) / (1 + l2/2).
  const Vector c = (Vector(4) << 3.0, -0.4, 0.6, -2.0).finished();
  const Vector z = elastic_net(Matrix::Identity(4, 4), c, {Vector::Ones(4), 0.5},
                               Vector::Zero(4));
  const Vector expected = (Vector(4) << 2.5 / 1.25, 0.0, 0.1 / 1.25, -1.5 / 1.25).finished();
  EXPECT_TRUE(z.isApprox(expected, 1e-9)) << z;
}

TEST(ElasticNet, FulfilsTheOptimalityConditions) {
  Random random(12);
  const auto data = testing::random_rows(40, 12, 4, 1.0, random);
  const LeastSquaresSystem system = data.system();
  const Subproblem problem = system.subproblem(0, system.all_terms());
  Vector l1(12);
  for (double& entry : l1) entry = random.uniform(2.0, 6.0);
  const ElasticPenalty penalty{l1, 0.3};
  const Vector z =
      elastic_net(problem.triangle(), problem.projected_target(), penalty, Vector::Zero(12));
  const Vector g = 2.0 * problem.triangle().transpose() *
                       (problem.projected_target() - problem.triangle() * z) -
                   penalty.l2 * z;
  int zeros = 0;
  for (Index j = 0; j < 12; ++j) {
    zeros += z[j] == 0.0 ? 1 : 0;
    if (z[j] == 0.0) {
      EXPECT_LE(std::abs(g[j]), l1[j] + 1e-6);
    } else {
      EXPECT_NEAR(g[j], std::copysign(l1[j], z[j]), 1e-6);
    }
  }
  EXPECT_GT(zeros, 0);
  EXPECT_LT(zeros, 12);
}

TEST(ElasticNet, FindsTheTermsAndDoesNotShrinkThem) {
  const LeastSquaresSystem system = testing::sparse_problem(300, 0.1, 0.0);
  const Subproblem all = system.subproblem(0, system.all_terms());
  const Regression fit = ElasticNet().fit(system, all);
  ASSERT_EQ(fit.active, (TermSet{1, 4, 7}));
  EXPECT_TRUE(fit.coefficients.isApprox(system.subproblem(0, {1, 4, 7}).solve(), 1e-10));
  for (const Removal& gone : fit.removed) EXPECT_LT(gone.value, gone.threshold);
}

/// Model 0 of Zou 2006: the columns in y are correlated by -0.39, the other one with each of them
/// by 0.23, so that the lasso's path takes it in before it has all of them.
testing::RandomRows deceptive_rows(Random& random) {
  Matrix covariance = Matrix::Constant(4, 4, 0.23);
  covariance.topLeftCorner(3, 3).setConstant(-0.39);
  covariance.diagonal().setOnes();
  testing::RandomRows data{Matrix(500, 4), Vector(500)};
  for (double& entry : data.theta.reshaped()) entry = random.normal();
  data.theta = data.theta * Matrix(covariance.llt().matrixU());
  data.y = 5.6 * data.theta.leftCols(3).rowwise().sum();
  for (double& entry : data.y) entry += 3.0 * random.normal();
  return data;
}

TEST(ElasticNet, AdaptivePenaltiesFindWhatTheLassoCannot) {
  Random random(21);
  int by_lasso = 0, adaptively = 0;
  for (int draw = 0; draw < 40; ++draw) {
    const LeastSquaresSystem system = deceptive_rows(random).system();
    const Subproblem problem = system.subproblem(0, system.all_terms());
    const auto found = [&](double adaptivity) {
      const ElasticNet regressor({.mix = 1.0, .adaptivity = adaptivity});
      return regressor.fit(system, problem).active == TermSet{0, 1, 2};
    };
    by_lasso += found(0.0) ? 1 : 0;
    adaptively += found(1.0) ? 1 : 0;
  }
  EXPECT_GE(adaptively, 36) << "the criterion alone takes a fourth term in one case of eighty";
  EXPECT_LE(by_lasso, 24) << "which has the right terms only where the fourth changes its sign";
}

}  // namespace
}  // namespace lacuna
