// SPDX-License-Identifier: MIT
#include "refinement_run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/records/known_noise.hpp"
#include "lacuna/core/base/error.hpp"
#include "state_guess.hpp"
#include "window_search.hpp"

namespace lacuna {
namespace {

/// Beyond this growth of errors in a window, initial states drown in rounding.
constexpr double kLargestGrowth = 1e6;

/// Noise below this fraction of a state's spread is rounding.
constexpr double kRoundingNoise = 1e-13;

/// Residuals below this fraction are those of the integration, not of the model.
constexpr double kIntegrationNoise = 1e-9;

/// A growth at which errors do not yet grow: a few times their size, as in damped oscillations.
constexpr double kNoGrowth = 5.0;

/// Longer windows that make standard errors smaller by less than this fraction are not worth
/// it.
constexpr double kSmallGain = 0.01;

/// Decreases of the cost, in units of the cost per degree of freedom, that end an iteration: a
/// tenth of a standard error on the way, a ten-thousandth at the end.
constexpr double kTolerance = 1e-2, kFinalTolerance = 1e-8;

/// The same for a model that is not exact, as fractions of the cost: beside correlated
/// residuals smaller steps say nothing.
constexpr double kCoarseFraction = 1e-3, kFineFraction = 1e-5;

constexpr Index kLags = 20;

Vector spread_of(const Matrix& states) {
  const Matrix centred = states.rowwise() - states.colwise().mean();
  Vector spread =
      centred.colwise().norm().transpose() / std::sqrt(static_cast<double>(states.rows()));
  for (Index k = 0; k < spread.size(); ++k)
    if (!(spread[k] > 0.0)) spread[k] = std::max(1.0, std::abs(states(0, k)));
  return spread;
}

/// Noise of the record in the order of the measured states.
Vector record_noise(const ShootingProblem& problem, const Dataset& data,
                    const std::optional<Vector>& known) {
  const Vector all = known_or_estimated(known, data);
  Vector noise(static_cast<Index>(problem.record().measured.size()));
  for (Index q = 0; q < noise.size(); ++q) {
    const auto k =
        static_cast<std::size_t>(problem.record().measured[static_cast<std::size_t>(q)]);
    const std::string& name = problem.model().symbolic().states()[k].name;
    for (std::size_t column = 0; column < data.states.size(); ++column)
      if (data.states[column].name == name) noise[q] = all[static_cast<Index>(column)];
  }
  return noise;
}

Index longest_window(const WindowPlan& plan) {
  Index longest = 0;
  for (const Window& window : plan) longest = std::max(longest, window.samples);
  return longest;
}

/// A problem that is refined, and how.
struct Task {
  ShootingProblem& problem;
  const RefinementStart& start;
  const RefineOptions& options;
  const RunContext& context;

  Vector measured_spread() const { return start.spread(problem.record().measured); }
};

ErrorGrowth scaled_growth(const Task& task, Matrix transitions) {
  const Vector& spread = task.start.spread;
  const Index m = task.problem.rates().dimension();
  for (Index j = 0; j < m; ++j)
    for (Index k = 0; k < m; ++k) transitions.col(j * m + k) *= spread[j] / spread[k];
  return {std::move(transitions), m};
}

/// Fits from the states on; the iterations that it took.
int minimise_from(const Task& task, ShootingFit& fit, const Matrix& states, double tolerance) {
  fit.point.starts = starts_of(fit.plan, states);
  fit.iterations = 0;
  minimise(task.problem, fit, tolerance, task.options.max_iterations, task.context);
  return fit.iterations;
}

/// Brings noise and scheme of the problem to those of a fit, and the fit to them.
/// @param taken degrees of freedom, as of residual_sigma().
void update_sigma(const Task& task, ShootingFit& fit, const Vector& taken = {}) {
  ShootingProblem& problem = task.problem;
  if (!task.options.sigma) {
    const Vector rounding = kRoundingNoise * task.measured_spread();
    problem.set_sigma(
        residual_sigma(problem, fit, task.options.huber.has_value(), taken).cwiseMax(rounding));
  }
  problem.set_scheme(accurate_scheme(problem, fit.plan, fit.point, problem.sigma()));
  problem.evaluate(fit.plan, fit.point);
  fit.linear = problem.linearise(fit.plan, fit.point);
}

/// Steps accurate enough for the model as it is, over a few samples from the guessed states.
void choose_scheme(const Task& task, const WindowPlan& plan) {
  ShootingProblem& problem = task.problem;
  ShootingPoint point{problem.model().values(), starts_of(plan, task.start.guess)};
  problem.set_scheme(accurate_scheme(problem, plan, point, problem.sigma()));
}

WindowLimits first_limits(const Task& task) {
  const ShootingRecord& record = task.problem.record();
  const auto rows = static_cast<Index>(record.measured.size());
  WindowLimits limits;
  limits.shortest = std::max<Index>(4, 2 * task.problem.rates().dimension() / rows + 2);
  limits.longest = std::max<Index>(record.samples(), 2);
  return limits;
}

/// Growth of errors along the record as guessed, every sampling interval being simulated on its
/// own.
ErrorGrowth guessed_growth(const Task& task) {
  ShootingProblem& problem = task.problem;
  ShootingFit steps;
  steps.point.parameters = problem.model().values();
  steps.plan = equal_windows(problem.record().begins, 1);
  steps.point.starts = starts_of(steps.plan, task.start.guess);
  problem.evaluate(steps.plan, steps.point);
  return scaled_growth(task, problem.linearise(steps.plan, steps.point).transitions);
}

/// Halves windows until none diverges; false if one always does.
bool make_finite(const Task& task, ShootingFit& fit) {
  ShootingProblem& problem = task.problem;
  for (Index samples = longest_window(fit.plan); samples > 1; samples /= 2) {
    fit.point.starts = starts_of(fit.plan, task.start.guess);
    problem.evaluate(fit.plan, fit.point);
    if (fit.point.finite) return true;
    fit.plan = equal_windows(problem.record().begins, std::max<Index>(samples / 2, 1));
  }
  return false;
}

/// The fit with the first windows.
RefinementRun first_fit(const Task& task, const WindowLimits& limits) {
  ShootingProblem& problem = task.problem;
  const std::vector<Index>& begins = problem.record().begins;
  problem.set_sigma(task.start.noise.cwiseMax(1e-6 * task.measured_spread()));
  choose_scheme(task, equal_windows(begins, limits.shortest));
  const ErrorGrowth growth = guessed_growth(task);
  RefinementRun run;
  run.fit.point.parameters = problem.model().values();
  run.fit.plan = task.options.window_samples
                     ? equal_windows(begins, *task.options.window_samples)
                     : plan_windows(begins, growth, limits);
  run.simulated = make_finite(task, run.fit);
  if (!run.simulated) return run;
  run.iterations = minimise_from(task, run.fit, task.start.guess, kTolerance);
  update_sigma(task, run.fit);
  return run;
}

/// Growth at which an error the size of the noise becomes as large as the attractor.
double growth_limit(const Task& task) {
  const Vector ratio = task.measured_spread().cwiseQuotient(task.problem.sigma());
  return std::clamp(ratio.minCoeff(), kNoGrowth, kLargestGrowth);
}

double cost_per_freedom(const ShootingProblem& problem, const ShootingFit& fit) {
  return fit.point.cost / static_cast<double>(degrees_of_freedom(problem, fit.plan));
}

/// Whether longer windows fit as well as the present ones: no worse than four standard
/// deviations of chi squared.
bool is_acceptable(const ShootingProblem& problem, const ShootingFit& longer,
                   const ShootingFit& present) {
  const auto freedom = static_cast<double>(degrees_of_freedom(problem, longer.plan));
  return cost_per_freedom(problem, longer) <=
         cost_per_freedom(problem, present) * (1.0 + 4.0 * std::sqrt(2.0 / freedom));
}

/// Mean relative decrease of the standard errors of p parameters by longer windows.
double gain_of(const ShootingFit& longer, const ShootingFit& present, Index p) {
  const auto variances = [p](const ShootingFit& fit) -> Vector {
    return covariance_of(fit.linear.reduced.topLeftCorner(p, p)).diagonal();
  };
  const Vector before = variances(present), after = variances(longer);
  if (!before.allFinite() || p == 0) return 1.0;
  return 0.5 * (before.array() / after.array()).log().mean();
}

/// The next longer windows, and the limits raised to them; nothing when there are none.
std::optional<WindowPlan> longer_plan(const Task& task, const ShootingFit& fit,
                                      WindowLimits& limits) {
  const ErrorGrowth growth = scaled_growth(task, fit.linear.transitions);
  const double limit = growth_limit(task);
  WindowPlan plan = fit.plan;
  while (plan.size() >= fit.plan.size()) {
    if (limits.growth >= limit && limits.turn > 1e9) return std::nullopt;
    limits.turn *= 2.0;
    limits.growth = std::min(4.0 * limits.growth, limit);
    plan = plan_windows(task.problem.record().begins, growth, limits);
  }
  return plan;
}

/// Doubles the windows; whether that is worth going on with.
bool lengthen(const Task& task, WindowLimits& limits, RefinementRun& run) {
  std::optional<WindowPlan> plan = longer_plan(task, run.fit, limits);
  if (!plan) return false;
  ShootingFit longer;
  longer.plan = std::move(*plan);
  longer.point.parameters = run.fit.point.parameters;
  run.iterations += minimise_from(task, longer, run.fit.point.orbits.samples, kTolerance);
  if (!longer.point.finite || !is_acceptable(task.problem, longer, run.fit)) return false;
  const double gain = gain_of(longer, run.fit, task.problem.model().size());
  run.fit = std::move(longer);
  update_sigma(task, run.fit);
  return gain > kSmallGain;
}

/// Whether the residuals are no white noise.
bool has_structure(const Task& task, const ShootingFit& fit) {
  ShootingProblem& problem = task.problem;
  const Vector least = kIntegrationNoise * task.measured_spread();
  if ((problem.sigma().array() < least.array()).all()) return false;
  const FitInfluence influence = fit_influence(problem, fit, kLags);
  for (const ResidualStatistics& s :
       residual_statistics(problem, fit, influence, task.start.noise))
    if (!s.white) return true;
  return false;
}

double residual_count(const ShootingProblem& problem) {
  return static_cast<double>(problem.record().values.size());
}

/// Takes the windows for a model that is not exact.
void search(const Task& task, const WindowLimits& limits, RefinementRun& run) {
  const ErrorGrowth growth = scaled_growth(task, run.fit.linear.transitions);
  const InexactWindows search{growth, growth_limit(task), limits.shortest,
                              kCoarseFraction * residual_count(task.problem),
                              task.options.max_iterations};
  run.fit = search_windows(task.problem, run.fit, search, task.context);
  update_sigma(task, run.fit);
}

/// Fits and noise in turn until both stand.
void polish(const Task& task, RefinementRun& run) {
  constexpr int kRounds = 4;
  ShootingProblem& problem = task.problem;
  const double tolerance =
      has_structure(task, run.fit) ? kFineFraction * residual_count(problem) : kFinalTolerance;
  for (int round = 0; round < kRounds; ++round) {
    const StepScheme scheme = problem.scheme();
    run.iterations += minimise_from(task, run.fit, run.fit.point.orbits.samples, tolerance);
    run.influence = fit_influence(problem, run.fit, kLags);
    const Vector sigma = problem.sigma();
    update_sigma(task, run.fit, run.influence.taken);
    const double change = (problem.sigma() - sigma).cwiseQuotient(sigma).cwiseAbs().maxCoeff();
    if (scheme == problem.scheme() && change < 1e-3) break;
  }
}

/// Goes on from the fit in the first windows to the end.
/// @param settled the last fit on the way that is whole. @throws OutOfTime past the deadline.
RefinementRun finished(const Task& task, WindowLimits limits, RefinementRun& settled) {
  RefinementRun run = settled;
  if (!task.options.window_samples) {
    if (!has_structure(task, run.fit))
      while (lengthen(task, limits, run)) {
        settled = run;
        task.context.report("refining", 0.5);
      }
    if (has_structure(task, run.fit)) search(task, limits, run);
  }
  polish(task, run);
  return run;
}

}  // namespace

RefinementStart refinement_start(ShootingProblem& problem, const Dataset& data,
                                 const RefineOptions& options) {
  Vector noise = options.sigma ? *options.sigma : record_noise(problem, data, options.noise);
  if (noise.size() != static_cast<Index>(problem.record().measured.size()))
    throw ArgumentError("refine", "there is not one sigma per measured state",
                        "leave it out or give one for each state that has a column");
  Matrix guess = options.states ? *options.states
                                : guess_states(problem.model(), problem.record(),
                                               problem.rates(), problem.signals(), noise);
  Vector spread = spread_of(guess);
  return {std::move(guess), std::move(noise), std::move(spread)};
}

RefinementRun run_refinement(ShootingProblem& problem, const RefinementStart& start,
                             const RefineOptions& options, const RunContext& context) {
  const RunContext unhurried = context.unhurried();
  const RunContext& needed = options.may_be_cut ? unhurried : context;
  needed.report("refining", 0.0);
  const Task first{problem, start, options, needed};
  WindowLimits limits = first_limits(first);
  RefinementRun run = first_fit(first, limits);
  if (!run.simulated) return run;
  try {
    return finished(Task{problem, start, options, context}, limits, run);
  } catch (const OutOfTime&) {
    if (!options.may_be_cut) throw;
  }
  run.in_time = false;
  update_sigma(first, run.fit);
  run.influence = fit_influence(problem, run.fit, kLags);
  return run;
}

}  // namespace lacuna
