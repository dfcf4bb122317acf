// SPDX-License-Identifier: MIT
#include "solvers/irls.hpp"

#include <algorithm>

#include "solvers/reweighting.hpp"

namespace lacuna {

Regression Irls::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                        Effort effort, const RunContext& context) const {
  ReweightingRule rule;
  rule.relative = options().tolerances == IrlsOptions::Tolerances::Relative;
  rule.delta = options().effective_delta();
  // To compare terms three digits more than their differences are enough.
  rule.tolerance =
      effort == Effort::Final ? options().tolerance : std::max(options().tolerance, 1e-5);
  rule.max_iterations = options().max_iterations;
  const auto solve = [](const Subproblem& weighted, const Vector&, const WeightFunction&) {
    return weighted.solve();
  };
  const ReweightingOutcome found = reweight(system, problem, rule, solve, context);
  return {problem.active(), found.coefficients, problem.residual_norm(found.coefficients),
          found.converged, found.iterations};
}

Stage<Regressor> irls(const IrlsOptions& options) { return Irls(options); }

}  // namespace lacuna
