// SPDX-License-Identifier: MIT
#include "lacuna/solvers/irls_l1.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/solvers/reweighting.hpp"

namespace lacuna {
namespace {

/// Moves the terms whose coefficient is zero from the active set to the removed ones.
/// @param gradient 2 |theta_j' W r| of the unit columns; @param penalty what it was held
/// against.
void drop_zeros(const Vector& h, const Vector& gradient, const Vector& penalty,
                Regression& result) {
  const TermSet all = result.active;
  std::vector<double> kept;
  result.active.clear();
  for (Index i = 0; i < h.size(); ++i) {
    const Index term = all[static_cast<std::size_t>(i)];
    if (h[i] == 0.0) {
      result.removed.push_back({term, "gradient of the weighted fit at h = 0",
                                std::abs(gradient[i]), penalty[i], result.iterations});
      continue;
    }
    result.active.push_back(term);
    kept.push_back(h[i]);
  }
  result.coefficients = Eigen::Map<const Vector>(kept.data(), static_cast<Index>(kept.size()));
}

}  // namespace

L1Problem IrlsL1::inner_problem(const Subproblem& weighted, const Vector& h) const {
  const Vector& norms = weighted.column_norms();
  L1Problem inner{weighted.triangle(), weighted.projected_target(), Vector(norms.size()),
                  h.cwiseProduct(norms)};
  if (options().tolerances == IrlsL1Options::Tolerances::Relative) {
    const Vector gradient = 2.0 * inner.triangle.transpose() * inner.target;
    inner.penalty.setConstant(options().alpha * gradient.cwiseAbs().maxCoeff());
  } else {
    for (Index j = 0; j < norms.size(); ++j)
      inner.penalty[j] = norms[j] > 0.0 ? options().alpha / norms[j] : 0.0;
  }
  return inner;
}

Regression IrlsL1::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                          Effort effort, const RunContext& context) const {
  ReweightingRule rule;
  rule.relative = options().tolerances == IrlsL1Options::Tolerances::Relative;
  rule.delta = options().effective_delta();
  rule.tolerance =
      effort == Effort::Final ? options().tolerance : std::max(options().tolerance, 1e-5);
  rule.max_iterations = options().max_iterations;
  Vector gradient = Vector::Zero(problem.size());
  Vector penalty = gradient;
  bool inner_converged = true;
  const auto solve = [&](const Subproblem& weighted, const Vector& h) {
    const L1Problem inner = inner_problem(weighted, h);
    const L1Solution found = options().inner->solve(inner, context);
    inner_converged = found.converged;
    penalty = inner.penalty;
    gradient =
        2.0 * inner.triangle.transpose() * (inner.target - inner.triangle * found.coefficients);
    const Vector& norms = weighted.column_norms();
    return Vector(
        (norms.array() > 0.0).select(found.coefficients.array() / norms.array(), 0.0));
  };
  const ReweightingOutcome found = reweight(system, problem, rule, solve, context);
  Regression result{problem.active(), found.coefficients,
                    problem.residual_norm(found.coefficients),
                    found.converged && inner_converged, found.iterations};
  drop_zeros(found.coefficients, gradient, penalty, result);
  return result;
}

}  // namespace lacuna
