// SPDX-License-Identifier: MIT
// Regressors that penalise coefficients.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "solvers/elastic_net.hpp"
#include "solvers/entropic.hpp"
#include "solvers/frols.hpp"
#include "solvers/stlsq.hpp"
#include "support/sparse_problem.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

using testing::RandomRows;
using testing::sparse_problem;

TEST(ElasticNet, OrthonormalColumnsAreThresholdedAndShrunk) {
  // min (c - z)^2 + l1 |z| + l2/2 z^2 has z = soft(c, l1/2) / (1 + l2/2).
  const Vector c = (Vector(4) << 3.0, -0.4, 0.6, -2.0).finished();
  const Vector z =
      elastic_net_minimum(Matrix::Identity(4, 4), c, {Vector::Ones(4), 0.5}, Vector::Zero(4));
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
  const Vector z = elastic_net_minimum(problem.triangle(), problem.projected_target(), penalty,
                                       Vector::Zero(12));
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

/// Model 0 of Zou 2006: the columns in y are correlated by -0.39, the other one with each of
/// them by 0.23, so that the lasso's path takes it in before it has all of them.
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

Regression fitted(const Regressor& regressor, const LeastSquaresSystem& system,
                  const RunContext& context = {}) {
  return regressor.fit(system, system.subproblem(0, system.all_terms()), Effort::Final,
                       context);
}

TEST(Entropic, TakesTheTermsThatExplainTheTarget) {
  for (const double noise : {0.0, 0.01, 0.1, 0.5})
    for (const std::uint64_t seed : {5, 6, 7}) {
      const Regression fit = fitted(Entropic(), sparse_problem(500, noise, 0.0, seed));
      EXPECT_EQ(fit.active, (TermSet{1, 4, 7})) << noise << " " << seed;
      for (const Removal& gone : fit.removed) EXPECT_LE(gone.value, gone.threshold);
    }
}

/// The second equation of Lorenz, dy/dt = 28 x - y - x z, among the 20 terms of degree 3, on
/// points of a box; one rate of ten is off by ten times the deviation of all.
RandomRows lorenz_with_outliers(double noise) {
  Random random(3);
  const Index n = 1000;
  RandomRows rows{Matrix(n, 20), Vector(n)};
  for (Index i = 0; i < n; ++i) {
    const double x = random.uniform(-18.0, 18.0), y = random.uniform(-25.0, 25.0),
                 z = random.uniform(2.0, 46.0);
    Index term = 0;
    for (int a = 0; a <= 3; ++a)
      for (int b = 0; a + b <= 3; ++b)
        for (int c = 0; a + b + c <= 3; ++c)
          rows.theta(i, term++) = std::pow(x, a) * std::pow(y, b) * std::pow(z, c);
    rows.y[i] = 28.0 * x - y - x * z + noise * random.normal();
    if (random.uniform() < 0.1) rows.y[i] += 2000.0 * random.normal();
  }
  return rows;
}

TEST(Entropic, OutliersDoNotLeadIt) {
  for (const double noise : {0.0, 2.0}) {
    const LeastSquaresSystem system = lorenz_with_outliers(noise).system();
    const Regression fit = fitted(Entropic(), system);
    // y, x and x z in this order of exponents.
    ASSERT_EQ(fit.active, (TermSet{4, 10, 11})) << noise;
    EXPECT_NEAR(fit.coefficients[0], -1.0, 0.02);
    EXPECT_NEAR(fit.coefficients[1], 28.0, 0.1);
    EXPECT_NEAR(fit.coefficients[2], -1.0, 0.01);
    for (const double threshold : {0.01, 0.03, 0.1, 0.3, 1.0})
      EXPECT_NE(fitted(Stlsq({.threshold = threshold}), system).active, fit.active)
          << threshold;
    EXPECT_NE(fitted(Frols(), system).active, fit.active);
  }
}

TEST(Entropic, TakesAConstantWhereThereIsOne) {
  Random random(4);
  RandomRows rows{Matrix(400, 4), Vector(400)};
  for (Index i = 0; i < 400; ++i) {
    rows.theta.row(i) << 1.0, random.uniform(5.0, 6.0), random.normal(), random.normal();
    rows.y[i] = 2.0 * rows.theta(i, 1) + 0.1 * random.normal();
  }
  EXPECT_EQ(fitted(Entropic(), rows.system()).active, (TermSet{1}));
  rows.y.array() += 3.0;
  EXPECT_EQ(fitted(Entropic(), rows.system()).active, (TermSet{0, 1}));
}

TEST(Entropic, TakesNothingOfNoise) {
  int taken = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    RandomRows rows = testing::random_rows(200, 10, 0, 1.0, random);
    taken += !fitted(Entropic(), rows.system()).active.empty();
  }
  EXPECT_LE(taken, 5);
}

TEST(Entropic, TheSeedDecidesWhichRowsOfManyAreLookedAt) {
  const LeastSquaresSystem system = sparse_problem(5000, 0.1, 0.05);
  const Entropic few({.samples = 300});
  RunContext other;
  other.seed = 17;
  EXPECT_EQ(fitted(few, system).coefficients, fitted(few, system).coefficients);
  EXPECT_EQ(fitted(few, system).active, (TermSet{1, 4, 7}));
  EXPECT_EQ(fitted(few, system, other).active, (TermSet{1, 4, 7}));
}

TEST(Entropic, TakesOneOfEqualTermsAndNoMoreThanAllowed) {
  const LeastSquaresSystem system = sparse_problem(300, 0.1, 0.0);
  EXPECT_EQ(fitted(Entropic({.max_terms = 1}), system).active, (TermSet{1}));
  Random random(5);
  RandomRows rows = testing::random_rows(200, 3, 0, 0.1, random);
  rows.theta.col(2) = rows.theta.col(1);
  rows.y += rows.theta.col(1);
  EXPECT_EQ(fitted(Entropic(), rows.system()).active.size(), 1u);
}

}  // namespace
}  // namespace lacuna
