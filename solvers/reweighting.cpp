// SPDX-License-Identifier: MIT
#include "solvers/reweighting.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

double median_of_magnitudes(Vector residuals) {
  residuals = residuals.cwiseAbs();
  double* middle = residuals.data() + residuals.size() / 2;
  std::nth_element(residuals.data(), middle, residuals.data() + residuals.size());
  return *middle;
}

WeightFunction weights_of(double delta, bool relative) {
  const double numerator = relative ? delta : 1.0;
  return [delta, numerator](const Eigen::Ref<const Vector>& residuals,
                            Eigen::Ref<Vector> weights) {
    weights = numerator / residuals.array().abs().max(delta);
  };
}

/// The largest change of a term between two sets of coefficients, relative to the largest term.
double relative_change(const Subproblem& problem, const Vector& from, const Vector& to) {
  const Vector& norms = problem.column_norms();
  const double largest =
      std::max(problem.target_norm(), to.cwiseProduct(norms).cwiseAbs().maxCoeff());
  return (to - from).cwiseProduct(norms).cwiseAbs().maxCoeff() / largest;
}

}  // namespace

ReweightingOutcome reweight(const LeastSquaresSystem& system, const Subproblem& problem,
                            const ReweightingRule& rule, WeightedSolve solve,
                            const RunContext& context) {
  ReweightingOutcome outcome{problem.solve()};
  if (problem.target_norm() == 0.0) return {Vector::Zero(problem.size()), true, 0};
  const double floor =
      1e-13 * problem.target_norm() / std::sqrt(static_cast<double>(problem.rows()));
  double median = problem.target_norm();
  while (!outcome.converged && outcome.iterations < rule.max_iterations) {
    Vector& h = outcome.coefficients;
    if (rule.relative)
      median = std::min(median, median_of_magnitudes(system.residuals(
                                    problem.target(), problem.active(), h, context)));
    const double delta = rule.relative ? rule.delta * std::max(median, floor) : rule.delta;
    const WeightFunction weights = weights_of(delta, rule.relative);
    const Vector next = solve(system.reweighted(problem, h, weights, context), h, weights);
    outcome.converged = relative_change(problem, h, next) <= rule.tolerance;
    h = next;
    ++outcome.iterations;
  }
  return outcome;
}

}  // namespace lacuna
