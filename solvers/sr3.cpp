// SPDX-License-Identifier: MIT
#include "solvers/sr3.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "subset_fit.hpp"

namespace lacuna {
namespace {

/// The last step of Sr3.
Vector thresholded(const Vector& z, const Sr3Options& options, double limit) {
  using Penalty = Sr3Options::Penalty;
  const auto sizes = z.array().abs();
  const Vector kept = (sizes >= limit && sizes > 0.0).select(z.array(), 0.0);
  if (options.penalty == Penalty::L0) return kept;
  const Vector shrunk = z.array().sign() * (sizes - limit).max(0.0);
  if (options.penalty == Penalty::L1) return shrunk;
  return (sizes >= (options.clip + 0.5) * limit).select(kept, shrunk);
}

}  // namespace

Regression Sr3::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                       Effort effort, const RunContext& context) const {
  const double stiffness = 1.0 / options().relaxation;
  const double scale = problem.target_norm();
  Matrix normal = problem.triangle().transpose() * problem.triangle();
  normal.diagonal().array() += stiffness;
  const Eigen::LLT<Matrix> factor(normal);
  const Vector right = problem.triangle().transpose() * problem.projected_target();
  Vector z = problem.solve().cwiseProduct(problem.column_norms());
  const double limit = options().threshold * scale;
  Vector w = thresholded(z, options(), limit);
  SubsetChoice choice{.quantity = "|h theta| / |y| of the relaxed fit",
                      .threshold = options().threshold,
                      .converged = false};
  while (!choice.converged && choice.iterations < options().max_iterations) {
    context.check_stop();
    z = factor.solve(right + stiffness * w);
    const Vector next = thresholded(z, options(), limit);
    choice.converged = (next - w).cwiseAbs().maxCoeff() <= 1e-10 * scale;
    w = next;
    ++choice.iterations;
  }
  choice.positions = support_of(w);
  choice.values = z.cwiseAbs() * (scale > 0.0 ? 1.0 / scale : 0.0);
  return regression_on(system, problem, choice, effort, context);
}

Stage<Regressor> sr3(const Sr3Options& options) { return Sr3(options); }

}  // namespace lacuna
