// SPDX-License-Identifier: MIT
// What holds for several regressors in the same way.
#include <gtest/gtest.h>

#include "lacuna/solvers/elastic_net.hpp"
#include "lacuna/solvers/entropic.hpp"
#include "lacuna/solvers/frols.hpp"
#include "lacuna/solvers/irls.hpp"
#include "lacuna/solvers/irls_l1.hpp"
#include "lacuna/solvers/l1/l1_coordinate_descent.hpp"
#include "lacuna/solvers/ols.hpp"
#include "lacuna/solvers/stlsq.hpp"
#include "support/stage_invariance.hpp"

namespace lacuna {
namespace {

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
