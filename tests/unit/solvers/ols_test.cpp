// SPDX-License-Identifier: MIT
#include "lacuna/solvers/ols.hpp"

#include <gtest/gtest.h>

#include "support/rossler_system.hpp"

namespace lacuna {
namespace {

using testing::monomial_system;
using testing::rossler_10000;

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

}  // namespace
}  // namespace lacuna
