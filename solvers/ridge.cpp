// SPDX-License-Identifier: MIT
#include "lacuna/solvers/ridge.hpp"

#include "subset_fit.hpp"

namespace lacuna {

Regression Ridge::do_fit(const LeastSquaresSystem&, const Subproblem& problem, Effort,
                         const RunContext&) const {
  const Vector penalty = Vector::Constant(problem.size(), options().alpha);
  const Vector z = ridge_solution(problem.triangle(), problem.projected_target(), penalty);
  const Vector& norms = problem.column_norms();
  const Vector h = (norms.array() > 0.0).select(z.array() / norms.array(), 0.0);
  return {problem.active(), h, problem.residual_norm(h)};
}

}  // namespace lacuna
