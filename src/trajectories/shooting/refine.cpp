// SPDX-License-Identifier: MIT
#include "trajectories/shooting/refine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "confidence.hpp"
#include "data/records/known_noise.hpp"
#include "lacuna/core/base/error.hpp"
#include "refinement_run.hpp"

namespace lacuna {
namespace {

/// What every result has, whether the fit succeeded or not.
Refinement basic_result(const ShootingProblem& problem, const RefinementRun& run) {
  return {.model = problem.model().with_values(run.fit.point.parameters),
          .iterations = run.iterations,
          .in_time = run.in_time,
          .measured = problem.record().measured,
          .sigma = problem.sigma(),
          .windows = run.fit.plan,
          .states = run.fit.point.orbits.samples};
}

/// @param guess states from which the fit started.
Refinement diverged_result(const ShootingProblem& problem, const RefinementRun& run,
                           const Matrix& guess) {
  Refinement result = basic_result(problem, run);
  const Index p = result.model.size();
  const double infinity = std::numeric_limits<double>::infinity();
  result.status = RefineStatus::Diverged;
  result.message = "the model diverges within a few sampling intervals of the record";
  result.standard_errors = result.bound = Vector::Constant(p, infinity);
  result.covariance = Matrix::Constant(p, p, infinity);
  result.ci95.resize(p, 2);
  result.ci95 << -result.standard_errors, result.standard_errors;
  result.states = guess;
  return result;
}

/// Covariance and intervals: from the Fisher information where residuals are noise, else from
/// blocks of the record, when that gives more.
void add_errors(const ShootingProblem& problem, const ShootingFit& fit,
                const std::optional<double>& huber, Refinement& result) {
  const Index p = result.model.size();
  const Matrix inverse = covariance_of(fit.linear.reduced.topLeftCorner(p, p));
  result.bound = inverse.diagonal().cwiseSqrt();
  result.covariance =
      inverse * (huber ? robust_factor(problem.residuals(fit.plan, fit.point), *huber) : 1.0);
  auto freedom = static_cast<double>(result.degrees_of_freedom);
  std::optional<Matrix> blocks;
  if (!result.white && inverse.allFinite())
    blocks = block_covariance(fit.linear.windows, inverse);
  if (blocks && blocks->trace() > 0.0) {
    result.covariance = *blocks;
    freedom = std::max(1.0, static_cast<double>(std::max(kCovarianceBlocks, 2 * p) - p));
  }
  result.standard_errors = result.covariance.diagonal().cwiseSqrt();
  result.ci95 = intervals95(fit.point.parameters, result.standard_errors, freedom);
}

/// @param noise of the record or as given, per measured state.
Refinement full_result(const ShootingProblem& problem, const RefinementRun& run,
                       const Vector& noise, const RefineOptions& options) {
  const ShootingFit& fit = run.fit;
  Refinement result = basic_result(problem, run);
  result.status = fit.converged ? RefineStatus::Converged : RefineStatus::IterationLimit;
  if (!fit.converged)
    result.message = "the iteration limit was reached; the values are those of the last step";
  result.degrees_of_freedom = degrees_of_freedom(problem, fit.plan);
  result.chi_squared = problem.residuals(fit.plan, fit.point).squaredNorm();
  result.residuals = residual_statistics(problem, fit, run.influence, noise);
  const auto all = [&](bool ResidualStatistics::*property) {
    return std::all_of(result.residuals.begin(), result.residuals.end(),
                       [&](const ResidualStatistics& s) { return s.*property; });
  };
  result.white = all(&ResidualStatistics::white);
  result.fits_to_noise = all(&ResidualStatistics::is_noise);
  add_errors(problem, fit, options.huber, result);
  return result;
}

void check_options(const ParametrisedModel& model, const Dataset& data,
                   const RefineOptions& options) {
  if (options.huber && !(*options.huber > 0.0))
    throw ArgumentError("refine", "the bound of the robust loss is not positive",
                        "give a number of standard deviations, e.g. 1.345");
  if (options.window_samples && *options.window_samples < 2)
    throw ArgumentError("refine", "windows of fewer than two samples show nothing",
                        "give at least 2, or leave it out");
  if (options.states && (options.states->rows() != data.samples() ||
                         options.states->cols() != model.symbolic().dimension()))
    throw ArgumentError("refine", "the starting states do not fit record and model",
                        "give one row per sample and one column per state");
  if (options.sigma && !(options.sigma->minCoeff() > 0.0))
    throw ArgumentError("refine", "a noise is not positive",
                        "give a positive sigma for each measured state");
  check_known(options.noise, data, "refine");
}

}  // namespace

std::string to_string(RefineStatus status) {
  switch (status) {
    case RefineStatus::Converged:
      return "converged";
    case RefineStatus::IterationLimit:
      return "iteration limit";
    default:
      return "diverged";
  }
}

OdeModel Refinement::fitted() const {
  const OdeModel plain = model.model();
  std::vector<Equation> equations = plain.equations();
  for (std::size_t i = 0; i < model.coefficients().size(); ++i) {
    const FreeCoefficient& c = model.coefficients()[i];
    const auto p = static_cast<Index>(i);
    const auto k = static_cast<std::size_t>(c.equation);
    // Terms that have become one have no error of their own.
    const bool joined = equations[k].size() != model.symbolic().equations()[k].size();
    if (!std::isfinite(standard_errors[p]) || joined) continue;
    WeightedTerm& summand = equations[k][static_cast<std::size_t>(c.summand)];
    summand.standard_error = standard_errors[p];
    summand.ci95 = {{ci95(p, 0), ci95(p, 1)}};
  }
  return plain.with_equations(std::move(equations));
}

Refinement refine(const ParametrisedModel& model, const Dataset& record,
                  const RefineOptions& options, const RunContext& context) {
  if (lacks_input_columns(record))
    return refine(model, with_input_columns(record), options, context);
  check_dataset(record);
  check_options(model, record, options);
  ShootingProblem problem(model, record, options.huber, context.threads);
  const RefinementStart start = refinement_start(problem, record, options);
  const RefinementRun run = run_refinement(problem, start, options, context);
  return run.simulated ? full_result(problem, run, start.noise, options)
                       : diverged_result(problem, run, start.guess);
}

}  // namespace lacuna
