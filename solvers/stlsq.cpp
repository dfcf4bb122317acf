// SPDX-License-Identifier: MIT
#include "solvers/stlsq.hpp"

#include <cmath>

#include "subset_fit.hpp"

namespace lacuna {
namespace {

using Scale = StlsqOptions::Scale;

Vector inverse_or_zero(const Vector& norms) {
  return (norms.array() > 0.0).select(norms.array().inverse(), 0.0);
}

std::vector<Index> below(const Vector& measures, double threshold) {
  std::vector<Index> positions;
  for (Index i = 0; i < measures.size(); ++i)
    if (measures[i] < threshold || measures[i] == 0.0) positions.push_back(i);
  return positions;
}

}  // namespace

Vector Stlsq::measures(const Subproblem& problem) const {
  const Vector& norms = problem.column_norms();
  const bool contribution = options().scale == Scale::Contribution;
  Vector h;
  if (options().alpha.value_or(0.0) > 0.0) {
    const Vector weight =
        contribution ? Vector(Vector::Ones(norms.size())) : inverse_or_zero(norms);
    h = ridge_solution(problem.triangle(), problem.projected_target(),
                       *options().alpha * weight.cwiseAbs2())
            .cwiseProduct(inverse_or_zero(norms));
  } else {
    h = problem.solve();
  }
  if (!contribution) return h.cwiseAbs();
  const double scale = problem.target_norm();
  return h.cwiseAbs().cwiseProduct(norms) * (scale > 0.0 ? 1.0 / scale : 0.0);
}

Regression Stlsq::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                         Effort effort, const RunContext& context) const {
  const std::string quantity =
      options().scale == Scale::Contribution ? "|h theta| / |y|" : "|h|";
  Subproblem left = problem;
  Regression result;
  result.converged = false;
  while (result.iterations < options().max_iterations && !result.converged) {
    const Vector values = measures(left);
    const std::vector<Index> small = below(values, options().threshold);
    result.converged = small.empty();
    ++result.iterations;
    for (auto i = small.rbegin(); i != small.rend(); ++i) {
      result.removed.push_back({left.active()[static_cast<std::size_t>(*i)], quantity,
                                values[*i], options().threshold, result.iterations});
      left.remove(*i);
    }
  }
  result.active = left.active();
  result.coefficients = left.solve();
  result.residual_norm = left.residual_norm();
  if (effort == Effort::Final && left.size() > 0)
    result.coefficients = system.refined(left, result.coefficients, context);
  return result;
}

Stage<Regressor> stlsq(const StlsqOptions& options) { return Stlsq(options); }

}  // namespace lacuna
