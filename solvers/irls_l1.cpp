// SPDX-License-Identifier: MIT
#include "solvers/irls_l1.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solvers/l1/l1_optimality.hpp"
#include "solvers/reweighting.hpp"

namespace lacuna {
namespace {

/// Moves the terms whose coefficient is zero from the active set to the removed ones.
/// @param gradient 2 |theta_j' W r| of the unit columns; @param penalty what it was compared
/// with.
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

/// a / b, 0 where b is.
Vector quotient(const Vector& a, const Vector& b) {
  return (b.array() > 0.0).select(a.array() / b.array(), 0.0);
}

/// Once the weights have settled, the zeros and signs of the last pass are mostly those of the
/// next: then the optimality conditions accept the exact solve and the inner solver is not
/// needed.
L1Solution solved(const L1Problem& problem, const L1Solver& solver, const RunContext& context) {
  if (std::optional<Vector> same_signs = l1_polished(problem, problem.start))
    return {std::move(*same_signs), 0, true};
  return solver.solve(problem, context);
}

}  // namespace

Vector IrlsL1::penalties(const LeastSquaresSystem& system, const Subproblem& problem,
                         const WeightFunction& weights, const RunContext& context) const {
  const Index k = problem.size();
  if (options().tolerances == IrlsL1Options::Tolerances::Paper)
    return Vector::Constant(k, options().alpha);
  const Subproblem null = system.reweighted(problem, Vector::Zero(k), weights, context);
  const Vector gradient = 2.0 * null.column_norms().cwiseProduct(null.triangle().transpose() *
                                                                 null.projected_target());
  const Vector& norms = problem.column_norms();
  return options().alpha * quotient(gradient, norms).cwiseAbs().maxCoeff() * norms;
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
  const auto solve = [&](const Subproblem& weighted, const Vector& h,
                         const WeightFunction& weights) {
    const Vector& norms = weighted.column_norms();
    penalty = quotient(penalties(system, problem, weights, context), norms);
    const L1Problem inner{weighted.triangle(), weighted.projected_target(), penalty,
                          h.cwiseProduct(norms)};
    const L1Solution solution = solved(inner, *options().inner, context);
    inner_converged = solution.converged;
    gradient = 2.0 * inner.triangle.transpose() *
               (inner.target - inner.triangle * solution.coefficients);
    return quotient(solution.coefficients, norms);
  };
  const ReweightingOutcome found = reweight(system, problem, rule, solve, context);
  Regression result{problem.active(), found.coefficients,
                    problem.residual_norm(found.coefficients),
                    found.converged && inner_converged, found.iterations};
  drop_zeros(found.coefficients, gradient, penalty, result);
  return result;
}

Stage<Regressor> irls_l1(const IrlsL1Options& options) { return IrlsL1(options); }

}  // namespace lacuna
