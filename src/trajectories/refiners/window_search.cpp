// SPDX-License-Identifier: MIT
#include "window_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "data/records/known_noise.hpp"
#include "lacuna/data/records/noise.hpp"
#include "move_path.hpp"
#include "refitted.hpp"
#include "regression/formulations/test_functions.hpp"
#include "trajectories/subset_selection/candidate_screening.hpp"
#include "trajectories/subset_selection/subset_problem.hpp"
#include "window_iterations.hpp"
#include "window_resolution.hpp"

namespace lacuna {
namespace {

Vector noise_or_floor(const Dataset& data, const std::vector<StateNoise>& noise) {
  Vector sigma = rounding_floor(data);
  for (Index k = 0; k < sigma.size(); ++k)
    sigma[k] = std::max(sigma[k], noise[static_cast<std::size_t>(k)].sigma);
  return sigma;
}

/// What constraints may ask for has to be there.
void add_constrained(const SearchTask& task, std::vector<Coefficient>& columns) {
  if (task.constraints.empty()) return;
  for (const auto& [equation, term] : constrained_coefficients(task.constraints))
    columns.push_back({equation, term});
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
}

/// Coefficients of what is no column are 0.
void drop_others(WindowFit& fit) {
  Matrix kept = Matrix::Zero(fit.coefficients.rows(), fit.coefficients.cols());
  for (const Coefficient& column : fit.columns)
    kept(column.equation, column.term) = fit.coefficients(column.equation, column.term);
  fit.coefficients = std::move(kept);
  fit.subset = present_columns(fit);
}

/// Samples that are fitted in all.
Index most_samples(const SearchTask& task) {
  // A fact of cost.
  constexpr Index kMostValues = 200000;
  return std::min(kMostSamples, kMostValues / task.equations.dimension());
}

/// Samples of windows that a choice takes: among few candidates no fewer than eight windows.
Index samples_in_windows(const SearchTask& task, const WindowSearch& search, Index samples) {
  // A fact of the statistic: fewer windows do not stand for a record.
  constexpr Index kFewestWindows = 8;
  return is_wide(task) ? search.most
                       : std::min(most_samples(task),
                                  std::max(search.most, kFewestWindows * samples));
}

/// Fits windows of so many samples.
/// @param rounds of choices at most.
void fit_windows(const SearchTask& task, WindowSearch& search, const Matrix& coefficients,
                 Index samples, const RunContext& context, int rounds = kRoundsOfChoices) {
  // A fact of the search: bounds the work where noise and steps take turns.
  constexpr int kPasses = 5;
  search.path.windows = windows_of(search.path.records, samples,
                                   samples_in_windows(task, search, samples));
  search.fit = WindowFit();
  search.fit.coefficients = coefficients;
  search.fit.samples = samples;
  search.fit.columns =
      is_wide(task) ? screen_candidates(task, search, context).plausible : task.candidates;
  add_constrained(task, search.fit.columns);
  drop_others(search.fit);
  for (int pass = 0; pass < kPasses; ++pass) {
    converge(task, search, context, rounds);
    if (rounds < kRoundsOfChoices && !search.fit.settled) break;
    const bool quieter = learn_noise(task, search);
    if (quieter) search.steps = {};
    const bool finer = asks_for_a_step_test(search) && refine_steps(task, search, context);
    if (!quieter && !finer) break;
  }
  search.fit.kept_terms = have_same_terms(search.fit.coefficients, coefficients);
  mask_beyond(search.path, kOutlyingDeviations * std::sqrt(std::max(1.0, search.fit.misfit)));
}

/// Samples that a choice takes: four for each candidate of an equation, and values enough to
/// distinguish terms from noise; more where candidates are few. What is chosen is fitted to all
/// of them in the end, where terms may still come and go (take_all_windows()).
Index samples_of_a_choice(const SearchTask& task) {
  // Facts of cost and of the statistic.
  constexpr Index kValuesOfAChoice = 30000, kSamplesOfACandidate = 4, kSamplesAmongFew = 4000;
  const Index enough = std::max(kValuesOfAChoice / task.equations.dimension(),
                                kSamplesOfACandidate * task.equations.library.size());
  return std::min(most_samples(task),
                  is_wide(task) ? enough : std::max(enough, kSamplesAmongFew));
}

/// Whether longer windows fit no worse: by four standard deviations of chi squared. In windows
/// so short that terms do not show yet a straight line fits; what they leave is no measure.
bool acceptable(const WindowFit& before, const WindowFit& after) {
  if (after.rows == 0) return false;
  if (after.settled && after.subset.size() > before.subset.size() && after.scale > before.scale)
    return true;
  if (!after.settled && before.settled) return false;
  const double scatter =
      4.0 * std::sqrt(2.0 / static_cast<double>(std::max<Index>(1, after.rows)));
  return after.misfit <= before.misfit * (1.0 + scatter) + scatter;
}

/// A path that moves by so little, in units of sigma, leaves the coefficients where they are.
constexpr double kLastMove = 1e-3;  // a fact of the statistic

/// Whether paths can be known in windows of so many samples: chaos makes of the rounding of an
/// initial state a multiple that grows exponentially with their length, as two lengths show, and
/// beyond the last move it keeps the path from coming to rest.
bool is_resolved(const WindowSearch& search, Index samples) {
  const auto& [length, log_mean] = search.shorter;
  const WindowFit& fit = search.fit;
  if (length == 0) return true;
  const double rate =
      (fit.rounding.log_mean - log_mean) / static_cast<double>(fit.samples - length);
  const double later = std::log(fit.rounding.worst) +
                       std::max(0.0, rate) * static_cast<double>(samples - fit.samples);
  return later < std::log(kLastMove);
}

/// Whether there are windows of so many samples, and enough of them to stand for the records.
bool has_windows(const SearchTask& task, const WindowSearch& search, Index samples) {
  // A fact of the statistic.
  constexpr Index kFewestWindows = 16;
  return samples <= longest_record(task.data).samples() &&
         (!is_wide(task) || samples * kFewestWindows <= search.most);
}

/// Takes the fit of longer windows.
void take_longer(WindowSearch& search, WindowSearch longer) {
  longer.shorter = {search.fit.samples, search.fit.rounding.log_mean};
  search = std::move(longer);
}

/// Windows four times as long, where the terms have stayed in the last ones: most often they
/// stay again, and one choice shows it. @return whether they do and fit no worse.
bool leap(const SearchTask& task, WindowSearch& search, const RunContext& context) {
  constexpr Index kLeap = 4;  // a fact of the search: what does not settle goes on by twice
  const Index samples = kLeap * search.fit.samples;
  if (!search.leaps || !search.fit.kept_terms || !has_windows(task, search, samples) ||
      !is_resolved(search, samples))
    return false;
  WindowSearch longer = search;
  fit_windows(task, longer, search.fit.coefficients, samples, context, 1);
  search.leaps =
      longer.fit.settled && longer.fit.kept_terms && acceptable(search.fit, longer.fit);
  if (search.leaps) take_longer(search, std::move(longer));
  return search.leaps;
}

/// The terms left when the least valuable ones go as long as chi squared stays below a limit;
/// each equation keeps its last one, and constraints their coefficients.
std::vector<Index> simplest(const WindowSearch& search, const SubsetProblem& problem,
                            double limit) {
  const WindowFit& fit = search.fit;
  std::vector<Index> subset = fit.subset;
  const auto equation = [&](Index c) {
    return fit.columns[static_cast<std::size_t>(c)].equation;
  };
  for (;;) {
    Vector losses = losses_of(fit_subset(problem, subset));
    for (std::size_t i = 0; i < subset.size(); ++i)
      if (std::count_if(subset.begin(), subset.end(),
                        [&](Index c) { return equation(c) == equation(subset[i]); }) == 1 ||
          is_constrained(search, fit.columns[static_cast<std::size_t>(subset[i])]))
        losses[static_cast<Index>(i)] = std::numeric_limits<double>::infinity();
    Index least = 0;
    losses.minCoeff(&least);
    std::vector<Index> smaller = subset;
    smaller.erase(smaller.begin() + least);
    if (!std::isfinite(losses[least]) || fit_subset(problem, smaller).residual > limit)
      return subset;
    subset = std::move(smaller);
  }
}

Linearisation linearise_all(WindowSearch& search, const RunContext& context) {
  return linearise(search.rates, search.path, {search.fit.coefficients, search.fit.columns},
                   search.folding, context);
}

}  // namespace

bool have_same_terms(const Matrix& coefficients, const Matrix& others) {
  return ((coefficients.array() != 0.0) == (others.array() != 0.0)).all();
}

Index first_window(const Dataset& data, int threads, const std::optional<Vector>& noise) {
  const TestFunction function = choose_test_function(measured_part(data), {}, threads,
                                                     noise_of_measured_part(data, noise));
  const Trajectory& record = data.trajectories.front();
  // A fact: shorter windows leave no residual beside the initial state of many states.
  constexpr Index kFewestSamples = 8;
  return std::max(kFewestSamples,
                  static_cast<Index>(std::round(function.radius / mean_step(record))));
}

SearchTask search_task(Dataset data, const StructureTask& structure,
                       std::vector<StateNoise> noise, const TrajectorySelectionOptions& options,
                       int threads) {
  const auto& [library, allowed, constraints] = structure;
  std::vector<StateNoise> seen = noise;
  SampleNoise sample_noise = noise_of_samples(data, noise_or_floor(data, noise), noise,
                                              options.growing_noise, threads);
  for (std::size_t k = 0; k < noise.size(); ++k)
    if (sample_noise.growth[k]) noise[k].sigma = sample_noise.rms[static_cast<Index>(k)];
  SearchTask task{std::move(data),
                  {library, library.compile(), {}},
                  {},
                  std::move(noise),
                  std::move(seen),
                  std::move(sample_noise),
                  options.penalty,
                  constraints};
  for (Index k = 0; k < task.data.state_count(); ++k) {
    task.equations.exact.push_back(task.data.rate_state(k));
    if (task.equations.exact.back()) continue;
    TermSet terms(static_cast<std::size_t>(library.size()));
    std::iota(terms.begin(), terms.end(), Index{0});
    if (!allowed.empty()) terms = allowed[static_cast<std::size_t>(k)];
    for (const Index l : terms) task.candidates.push_back({k, l});
  }
  return task;
}

WindowSearch prepared_search(const SearchTask& task, const RunContext& context) {
  WindowedPath path{make_paths(task.data, task.sample_noise.deviations, task.equations.program,
                               context.threads),
                    {}};
  return {.rates = WindowRates(task.equations),
          .path = std::move(path),
          .sigma = task.sample_noise.rms,
          .floor = rounding_floor(task.data),
          .most = samples_of_a_choice(task),
          .shortest = std::min(first_window(task.data, context.threads, white_noise(task.seen)),
                               longest_record(task.data).samples()),
          .constraints = task.constraints};
}

WindowSearch begun(const SearchTask& task, WindowSearch prepared, const Matrix& coefficients,
                   const RunContext& context) {
  if (longest_record(task.data).samples() >= 4)
    fit_windows(task, prepared, coefficients, prepared.shortest, context);
  return prepared;
}

bool grow(const SearchTask& task, WindowSearch& search, const RunContext& context) {
  const Index samples = 2 * search.fit.samples;
  if (search.limited || !has_windows(task, search, samples)) return false;
  if (leap(task, search, context)) return true;
  search.limited = !is_resolved(search, samples);
  if (search.limited) return false;
  WindowSearch longer = search;
  fit_windows(task, longer, search.fit.coefficients, samples, context);
  search.limited = !acceptable(search.fit, longer.fit);
  if (!search.limited) take_longer(search, std::move(longer));
  return !search.limited;
}

void take_all_windows(const SearchTask& task, WindowSearch& search, const RunContext& context) {
  if (samples_in_windows(task, search, search.fit.samples) >=
      std::min(most_samples(task), task.data.samples()))
    return;
  WindowSearch all = search;
  all.most = most_samples(task);
  fit_windows(task, all, search.fit.coefficients, search.fit.samples, context);
  all.limited = search.limited;
  if (acceptable(search.fit, all.fit)) search = std::move(all);
}

void check_steps(const SearchTask& task, WindowSearch& search, const RunContext& context) {
  const bool is_longer = search.steps.samples < search.fit.samples;
  if (is_longer && refine_steps(task, search, context)) converge(task, search, context);
}

void finish(WindowSearch& search, const RunContext& context) {
  settle(search, {.move = kLastMove, .iterations = 8}, context);
  summarise(search);
}

void simplify(const SearchTask& task, WindowSearch& search, double slack,
              const RunContext& context) {
  if (search.fit.subset.empty() || task.penalty) return;
  const Linearisation linearised = linearise_all(search, context);
  if (!linearised.triangle.allFinite()) return;
  const WindowFit found = search.fit;
  WindowFit& fit = search.fit;
  fit.triangle = linearised.triangle;
  const SubsetProblem problem = problem_of(fit);
  const double limit = std::pow(1.0 + slack, 2) * fit_subset(problem, fit.subset).residual;
  fit.subset = simplest(search, problem, limit);
  fit.penalty = std::max(fit.penalty, limit - fit_subset(problem, fit.subset).residual);
  move_path(search.rates, linearised, solve_subset(problem, search), search.path, context);
  finish(search, context);
  fit.sigma = found.sigma;  // the noise is what it was
  fit.triangle = linearise_all(search, context).triangle;
  if (!fit.coefficients.allFinite() || !fit.triangle.allFinite()) fit = found;
}

}  // namespace lacuna
