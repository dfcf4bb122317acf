// SPDX-License-Identifier: MIT
#include "lacuna/solvers/irls.hpp"

#include <gtest/gtest.h>

#include "support/rossler_system.hpp"
#include "support/sparse_problem.hpp"

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

}  // namespace
}  // namespace lacuna
