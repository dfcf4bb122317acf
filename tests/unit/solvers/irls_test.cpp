// SPDX-License-Identifier: MIT
#include "lacuna/solvers/irls.hpp"

#include <gtest/gtest.h>

#include "support/sparse_problem.hpp"
#include "support/stage_invariance.hpp"

namespace lacuna {
namespace {

using testing::rossler_10000;

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

TEST(Irls, DoesNotDependOnHowDataAreWritten) {
  const Matrix states = rossler_10000().states.topRows(2000);
  const Matrix noisy = testing::with_noise(rossler_10000().derivatives.topRows(2000), 0.01, 3);
  const auto fit_of = [&](const testing::Rewriting& r) {
    const auto system = testing::rewritten(states, noisy, 2, r);
    const Index target = testing::new_target(2, r);
    const Regression fit = Irls().fit(system, system.subproblem(target, system.all_terms()));
    return testing::fractions(system, target, fit.active, fit.coefficients, r);
  };
  ASSERT_FALSE(testing::rewritings().empty());
  for (const auto& r : testing::rewritings()) {
    SCOPED_TRACE(r.name);
    testing::expect_same_fractions(fit_of({"same"}), fit_of(r), 1e-6);
  }
}

TEST(Irls, FitsATargetOfZeros) {
  const LeastSquaresSystem system(make_row_source(Matrix::Ones(5, 1), Matrix::Zero(5, 1)),
                                  {"1"}, {"y"});
  const Regression fit = Irls().fit(system, system.subproblem(0, {0}));
  EXPECT_TRUE(fit.converged);
  EXPECT_EQ(fit.coefficients[0], 0.0);
}

}  // namespace
}  // namespace lacuna
