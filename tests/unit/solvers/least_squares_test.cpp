// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "solvers/elastic_net.hpp"
#include "solvers/entropic.hpp"
#include "solvers/frols.hpp"
#include "solvers/gls.hpp"
#include "solvers/irls.hpp"
#include "solvers/irls_l1.hpp"
#include "solvers/l1/l1_coordinate_descent.hpp"
#include "solvers/ols.hpp"
#include "solvers/reweighting.hpp"
#include "solvers/ridge.hpp"
#include "solvers/stlsq.hpp"
#include "support/rossler_system.hpp"
#include "support/sparse_problem.hpp"
#include "support/stage_invariance.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

using testing::monomial_system;
using testing::rossler_10000;

// Least squares, with and without a ridge, a general covariance and weights that come of
// residuals.
TEST(Ols, FindsRosslersCoefficientsTo1e10) {
  const auto system = monomial_system(rossler_10000().states, rossler_10000().derivatives, 3);
  const Regression fit = Ols().fit(system, system.subproblem(1, system.all_terms()));
  ASSERT_EQ(fit.active.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    const std::string& name = system.term_names()[i];
    const double truth = name == "100" ? 1.0 : name == "010" ? 0.2 : 0.0;
    EXPECT_NEAR(fit.coefficients[static_cast<Index>(i)], truth, 1e-10) << name;
  }
  EXPECT_LE(fit.residual_norm, 1e-12 * system.factor().target_norms[1]);
}

TEST(Ols, FitsZeroTargetsDependentColumnsAndEmptySets) {
  Matrix theta = testing::make_monomials(rossler_10000().states.topRows(50), 1).values;
  theta.col(3) = theta.col(1) + theta.col(2);
  Matrix targets = Matrix::Zero(50, 2);
  targets.col(1) = 2.0 * theta.col(1) - theta.col(3);
  const LeastSquaresSystem system(make_row_source(theta, targets), {"1", "a", "b", "a+b"},
                                  {"zero", "dependent"});
  const auto all = system.all_terms();
  EXPECT_EQ(Ols().fit(system, system.subproblem(0, all)).coefficients.norm(), 0.0);
  const Regression fit = Ols().fit(system, system.subproblem(1, all));
  EXPECT_TRUE(fit.coefficients.allFinite());
  EXPECT_LE(system.residuals(1, fit.active, fit.coefficients).norm(), 1e-9 * targets.norm());
  const Regression nothing = Ols().fit(system, system.subproblem(1, {}));
  EXPECT_NEAR(nothing.residual_norm, targets.col(1).norm(), 1e-12 * targets.norm());
}

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
  EXPECT_TRUE(Ridge()
                  .fit(system, problem)
                  .coefficients.isApprox(
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

double error_of(const LeastSquaresSystem& system, const Regressor& regressor) {
  const Regression fit = regressor.fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_TRUE(fit.converged);
  return (fit.coefficients - testing::sparse_truth()).cwiseAbs().maxCoeff();
}

TEST(Irls, ResistsOutliers) {
  const auto system = testing::sparse_problem(2000, 0.05, 0.1);
  EXPECT_LE(error_of(system, Irls()), 0.02);
  IrlsOptions paper;
  paper.tolerances = IrlsOptions::Tolerances::Paper;
  paper.delta = 0.01;
  EXPECT_LE(error_of(system, Irls(paper)), 0.02);
  const Vector ols = system.subproblem(0, system.all_terms()).solve();
  EXPECT_GE((ols - testing::sparse_truth()).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Irls, EqualsLeastSquaresOnExactData) {
  const auto system =
      testing::monomial_system(rossler_10000().states, rossler_10000().derivatives, 2);
  const Regression fit = Irls().fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_TRUE(fit.converged);
  for (std::size_t i = 0; i < 10; ++i) {
    const std::string& name = system.term_names()[i];
    const double truth = name == "010" || name == "001" ? -1.0 : 0.0;
    EXPECT_NEAR(fit.coefficients[static_cast<Index>(i)], truth, 1e-10) << name;
  }
}

ReweightingOutcome plain(const LeastSquaresSystem& system, const ReweightingRule& rule) {
  const auto solve = [](const Subproblem& weighted, const Vector&, const WeightFunction&) {
    return weighted.solve();
  };
  return reweight(system, system.subproblem(0, system.all_terms()), rule, solve, {});
}

/// Sum of the Huber function of the residuals.
double huber(const LeastSquaresSystem& system, const Vector& h, double delta) {
  double sum = 0.0;
  for (const double r : system.residuals(0, system.all_terms(), h)) {
    const double size = std::abs(r);
    sum += size <= delta ? 0.5 * r * r / delta : size - 0.5 * delta;
  }
  return sum;
}

TEST(Reweighting, MinimisesTheHuberFunctionOfARawDelta) {
  const auto system = testing::sparse_problem(500, 0.1, 0.1);
  const double delta = 0.05;
  const ReweightingOutcome found = plain(system, {false, delta, 1e-12, 1000});
  EXPECT_TRUE(found.converged);
  const double best = huber(system, found.coefficients, delta);
  for (Index j = 0; j < 10; ++j) {
    for (const double step : {-1e-4, 1e-4}) {
      Vector moved = found.coefficients;
      moved[j] += step;
      EXPECT_GT(huber(system, moved, delta), best);
    }
  }
}

// What holds for several regressors in the same way.
struct InvariantFit {
  Stage<Regressor> regressor;
  Index target;
  double noise, tolerance;
};

TEST(Regressors, DoNotDependOnHowDataAreWritten) {
  const IrlsL1 lasso({.inner = CoordinateDescent(), .alpha = 1e-3});
  const Matrix states = testing::rossler_10000().states.topRows(2000);
  for (const InvariantFit& one : {InvariantFit{Ols(), 2, 0.01, 1e-10},
                                  {Irls(), 2, 0.01, 1e-6},
                                  {lasso, 1, 0.01, 1e-6},
                                  {Stlsq(), 2, 1e-3, 1e-9}}) {
    const Matrix rates =
        testing::with_noise(testing::rossler_10000().derivatives.topRows(2000), one.noise, 3);
    const auto fit_of = [&](const testing::Rewriting& r) {
      const auto system = testing::rewritten(states, rates, 2, r);
      const Index target = testing::new_target(one.target, r);
      const Regression fit =
          one.regressor->fit(system, system.subproblem(target, system.all_terms()));
      return testing::fractions(system, target, fit.active, fit.coefficients, r);
    };
    ASSERT_FALSE(fit_of({"same"}).empty());
    for (const auto& r : testing::rewritings()) {
      SCOPED_TRACE(std::string(one.regressor->info().name) + ", " + r.name);
      testing::expect_same_fractions(fit_of({"same"}), fit_of(r), one.tolerance);
    }
  }
}

TEST(Regressors, ATargetOfZerosNeedsNoTerm) {
  const LeastSquaresSystem system(make_row_source(Matrix::Ones(5, 1), Matrix::Zero(5, 1)),
                                  {"1"}, {"y"});
  for (const Stage<Regressor>& regressor : std::vector<Stage<Regressor>>{
           ElasticNet(), Entropic(), Frols(), Irls(), Ols(), Stlsq()}) {
    const Regression fit = regressor->fit(system, system.subproblem(0, {0}));
    EXPECT_EQ(fit.coefficients.norm(), 0.0) << regressor->info().name;
    EXPECT_EQ(fit.residual_norm, 0.0) << regressor->info().name;
    EXPECT_TRUE(fit.converged) << regressor->info().name;
  }
}

}  // namespace
}  // namespace lacuna
