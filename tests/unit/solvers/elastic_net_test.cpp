// SPDX-License-Identifier: MIT
#include "lacuna/solvers/elastic_net.hpp"

#include <gtest/gtest.h>

#include "support/sparse_problem.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

TEST(ElasticNet, OrthonormalColumnsAreThresholdedAndShrunk) {
  // min (c - z)^2 + l1 |z| + l2/2 z^2 has z = soft(c, l1/2) / (1 + l2/2).
  const Vector c = (Vector(4) << 3.0, -0.4, 0.6, -2.0).finished();
  const Vector z = elastic_net(Matrix::Identity(4, 4), c, {1.0, 0.5}, Vector::Zero(4));
  const Vector expected = (Vector(4) << 2.5 / 1.25, 0.0, 0.1 / 1.25, -1.5 / 1.25).finished();
  EXPECT_TRUE(z.isApprox(expected, 1e-9)) << z;
}

TEST(ElasticNet, FulfilsTheOptimalityConditions) {
  Random random(12);
  const auto data = testing::random_rows(40, 12, 4, 1.0, random);
  const LeastSquaresSystem system = data.system();
  const Subproblem problem = system.subproblem(0, system.all_terms());
  const ElasticPenalty penalty{4.0, 0.3};
  const Vector z =
      elastic_net(problem.triangle(), problem.projected_target(), penalty, Vector::Zero(12));
  const Vector g = 2.0 * problem.triangle().transpose() *
                       (problem.projected_target() - problem.triangle() * z) -
                   penalty.l2 * z;
  int zeros = 0;
  for (Index j = 0; j < 12; ++j) {
    zeros += z[j] == 0.0 ? 1 : 0;
    if (z[j] == 0.0) {
      EXPECT_LE(std::abs(g[j]), penalty.l1 + 1e-6);
    } else {
      EXPECT_NEAR(g[j], std::copysign(penalty.l1, z[j]), 1e-6);
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

TEST(ElasticNet, LeavesNothingOfATargetOfZeros) {
  const LeastSquaresSystem system(make_row_source(Matrix::Ones(5, 1), Matrix::Zero(5, 1)),
                                  {"1"}, {"y"});
  EXPECT_TRUE(ElasticNet().fit(system, system.subproblem(0, {0})).active.empty());
}

}  // namespace
}  // namespace lacuna
