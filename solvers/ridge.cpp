// SPDX-License-Identifier: MIT
#include "solvers/ridge.hpp"

#include <algorithm>

#include "subset_fit.hpp"

namespace lacuna {
namespace {

/// That of Hoerl, Kennard & Baldwin 1975.
double penalty_by_residual(const Subproblem& problem) {
  const Vector h = problem.solve();
  const double signal = h.cwiseProduct(problem.column_norms()).squaredNorm();
  const auto freedom = static_cast<double>(std::max<Index>(problem.rows() - problem.size(), 1));
  const double residual = problem.residual_norm(h);
  const double noise = residual * residual / freedom;
  return signal > 0.0 ? static_cast<double>(problem.size()) * noise / signal : 0.0;
}

}  // namespace

Regression Ridge::do_fit(const LeastSquaresSystem&, const Subproblem& problem, Effort,
                         const RunContext&) const {
  const double alpha = options().alpha ? *options().alpha : penalty_by_residual(problem);
  const Vector penalty = Vector::Constant(problem.size(), alpha);
  const Vector z = ridge_solution(problem.triangle(), problem.projected_target(), penalty);
  const Vector& norms = problem.column_norms();
  const Vector h = (norms.array() > 0.0).select(z.array() / norms.array(), 0.0);
  return {problem.active(), h, problem.residual_norm(h)};
}

Stage<Regressor> ridge(const RidgeOptions& options) { return Ridge(options); }

}  // namespace lacuna
