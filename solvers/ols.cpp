// SPDX-License-Identifier: MIT
#include "solvers/ols.hpp"

namespace lacuna {

Regression Ols::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                       Effort effort, const RunContext& context) const {
  Regression result;
  result.active = problem.active();
  result.coefficients = problem.solve();
  result.residual_norm = problem.residual_norm();
  if (effort == Effort::Final) {
    result.coefficients = system.refined(problem, result.coefficients, context);
    result.iterations = 1;
  }
  return result;
}

Stage<Regressor> ols(const OlsOptions& options) { return Ols(options); }

}  // namespace lacuna
