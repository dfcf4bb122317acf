// SPDX-License-Identifier: MIT
#include "trajectories/refiners/trajectory_selection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/text.hpp"
#include "core/numerics/constrained_least_squares.hpp"
#include "data/records/known_noise.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "record_stretches.hpp"
#include "refitted.hpp"
#include "trajectories/subset_selection/negligible_columns.hpp"
#include "trajectories/subset_selection/plain_candidates.hpp"
#include "trajectories/subset_selection/subset_problem.hpp"
#include "window_search.hpp"

namespace lacuna {
namespace {

/// Coefficients of a model as a matrix, m x L.
Matrix coefficients_of(const OdeModel& model, const TermLibrary& library) {
  const std::vector<std::string> names = library.names();
  Matrix coefficients = Matrix::Zero(model.dimension(), library.size());
  for (Index k = 0; k < model.dimension(); ++k)
    for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(k)]) {
      const auto found = std::find(names.begin(), names.end(), summand.term.name());
      if (found != names.end()) coefficients(k, found - names.begin()) = summand.coefficient;
    }
  return coefficients;
}

/// Builds what is handed back from a fit.
class Outcome {
 public:
  Outcome(const RefinerTask& task, const WindowFit& fit, const std::vector<StateNoise>& noise)
      : task_(task),
        fit_(fit),
        noise_(noise),
        problem_(subset_problem(fit.triangle / std::sqrt(std::max(1.0, fit.scale)))) {}

  RefinedModel make() const {
    RefinedModel result{.model = model()};
    result.noise = fit_.rms;
    for (Index k = 0; k < fit_.rms.size(); ++k) {
      judge(k, result);
      // What a wrong model leaves is no noise.
      if (!result.fits_to_noise.back().value_or(true))
        result.noise[k] = noise_[static_cast<std::size_t>(k)].sigma;
    }
    result.path = path();
    return result;
  }

 private:
  OdeModel model() const {
    std::vector<Equation> equations = task_.start.equations();
    for (std::size_t k = 0; k < equations.size(); ++k)
      if (!task_.data.rate_state(static_cast<Index>(k))) equations[k].clear();
    const double spread = std::sqrt(std::max(fit_.misfit / std::max(1.0, fit_.scale), 1e-300));
    const Vector variances = coefficient_variances();
    for (std::size_t i = 0; i < fit_.subset.size(); ++i) {
      const Coefficient column = fit_.columns[static_cast<std::size_t>(fit_.subset[i])];
      WeightedTerm summand{term(column), fit_.coefficients(column.equation, column.term)};
      const double error = spread * std::sqrt(variances[static_cast<Index>(i)]);
      const bool is_fixed = error <= 1e-12 * std::abs(summand.coefficient);
      if (std::isfinite(error) && !is_fixed) {
        summand.standard_error = error;
        summand.ci95 = interval95(summand.coefficient, error);
      }
      equations[static_cast<std::size_t>(column.equation)].push_back(std::move(summand));
    }
    return OdeModel(task_.data.states, task_.data.inputs, std::move(equations),
                    task_.data.time_unit);
  }

  /// Of the coefficients, rows being of unit variance.
  Vector coefficient_variances() const {
    if (task_.constraints.empty()) return variances_of(problem_, fit_.subset);
    CoefficientPlaces places;
    for (const Index c : fit_.subset) {
      const Coefficient& column = fit_.columns[static_cast<std::size_t>(c)];
      places.emplace_back(column.equation, column.term);
    }
    const ConstraintMatrix constraints = constraint_matrix(task_.constraints, places);
    const Matrix columns =
        problem_.scaled(Eigen::all, fit_.subset) * problem_.norms(fit_.subset).asDiagonal();
    return constrained_least_squares(columns, problem_.scaled.col(problem_.columns()),
                                     constraints.a, constraints.b)
        .variances;
  }

  const Term& term(const Coefficient& column) const {
    return task_.library.terms[static_cast<std::size_t>(column.term)];
  }

  /// Residuals are noise when their rms is not above what the record itself shows; that
  /// estimate is good to a tenth, and an rms of n values to 1 / sqrt(2 n) of it. Noise below
  /// what the integration resolves does not count against the model.
  void judge(Index state, RefinedModel& result) const {
    const StateNoise& noise = noise_[static_cast<std::size_t>(state)];
    const bool measured = fit_.counts[state] > 0.0;
    const double sigma = std::max(noise.sigma, fit_.sigma[state]);
    const double ratio = fit_.rms[state] / sigma;
    result.misfit.push_back(measured ? ratio : 0.0);
    if (!measured) return result.fits_to_noise.push_back(std::nullopt);
    const double scatter = 3.0 / std::sqrt(2.0 * fit_.counts[state]);
    result.fits_to_noise.push_back(ratio <= 1.1 + scatter);
  }

  std::vector<PathStep> path() const {
    std::vector<PathStep> steps;
    const Vector losses = losses_of(fit_subset(problem_, fit_.subset));
    const Vector gains = gains_of(problem_, fit_.subset);
    for (Index k = 0; k < task_.data.state_count(); ++k) {
      add_members(k, losses, steps);
      add_candidates(k, gains, steps);
    }
    return steps;
  }

  /// Terms of the model, most valuable first.
  void add_members(Index equation, const Vector& losses, std::vector<PathStep>& steps) const {
    const std::size_t begin = steps.size();
    for (std::size_t i = 0; i < fit_.subset.size(); ++i) {
      const Coefficient column = fit_.columns[static_cast<std::size_t>(fit_.subset[i])];
      if (column.equation == equation)
        steps.push_back({equation, term(column).name(), 0, true, losses[static_cast<Index>(i)],
                         fit_.penalty});
    }
    number(steps, begin);
  }

  /// The terms outside the model that would buy most.
  void add_candidates(Index equation, const Vector& gains, std::vector<PathStep>& steps) const {
    // For people.
    constexpr std::size_t kShown = 3;
    std::vector<PathStep> others;
    for (std::size_t c = 0; c < fit_.columns.size(); ++c)
      if (fit_.columns[c].equation == equation && gains[static_cast<Index>(c)] > 0.0)
        others.push_back({equation, term(fit_.columns[c]).name(), 0, false,
                          gains[static_cast<Index>(c)], fit_.penalty});
    number(others, 0);
    if (others.size() > kShown) others.resize(kShown);
    const Index members =
        std::count_if(steps.begin(), steps.end(),
                      [equation](const PathStep& step) { return step.equation == equation; });
    for (PathStep& step : others) step.terms = members + 1;
    steps.insert(steps.end(), others.begin(), others.end());
  }

  static void number(std::vector<PathStep>& steps, std::size_t begin) {
    std::stable_sort(steps.begin() + static_cast<std::ptrdiff_t>(begin), steps.end(),
                     [](const PathStep& a, const PathStep& b) { return a.gain > b.gain; });
    for (std::size_t i = begin; i < steps.size(); ++i)
      steps[i].terms = static_cast<Index>(i - begin) + 1;
  }

  const RefinerTask& task_;
  const WindowFit& fit_;
  const std::vector<StateNoise>& noise_;
  SubsetProblem problem_;
};

/// Names the terms that only one of two searches has.
void note_disputes(const RefinerTask& task, const WindowFit& first, const WindowFit& second,
                   std::vector<std::string>& notes) {
  for (Index k = 0; k < first.coefficients.rows(); ++k)
    for (Index l = 0; l < first.coefficients.cols(); ++l) {
      const bool here = first.coefficients(k, l) != 0.0;
      if (here == (second.coefficients(k, l) != 0.0)) continue;
      const std::string& term = task.library.terms[static_cast<std::size_t>(l)].name();
      const std::string& state = task.data.states[static_cast<std::size_t>(k)].name;
      notes.push_back("d" + state + "/dt: the term " + term + " is in dispute: " +
                      (here ? "in this model, not in" : "not in this model, but in") +
                      " the one that another search finds");
    }
}

/// Says where samples were weighed by noise that grows with the signal.
void note_growing_noise(const SearchTask& search, std::vector<std::string>& notes) {
  for (std::size_t k = 0; k < search.data.states.size(); ++k)
    if (const auto& growth = search.sample_noise.growth[k])
      notes.push_back("the noise of " + search.data.states[k].name + " grows with it: " +
                      format_number(100.0 * growth->fraction, 2) + " % of the value");
}

/// Why a record cannot be fitted, or, when a model is already there, why that needs no fit.
std::string reason_to_leave(const RefinerTask& task, const std::vector<StateNoise>& noise,
                            bool from_model) {
  if (task.data.has_derivatives() && task.data.rate_of.empty())
    return "the record brings derivatives of its own";
  if (!from_model) return "";
  // What differences of a clean record leave; more is for the trajectories to explain.
  constexpr double kTruncation = 1e-5;
  if (task.unexplained <= kTruncation &&
      std::all_of(noise.begin(), noise.end(),
                  [](const StateNoise& state) { return state.kind == NoiseKind::None; }))
    return "the record has no noise that could be distinguished from the signal";
  return "";
}

bool fits_to_noise(const RefinedModel& model) {
  return std::all_of(model.fits_to_noise.begin(), model.fits_to_noise.end(),
                     [](const std::optional<bool>& fits) { return fits.value_or(true); });
}

/// Searches from the start and, when asked to, beside it from nothing, until the two agree.
struct Searches {
  WindowSearch first;
  std::optional<WindowSearch> second;  ///< as long as the two do not agree
  bool is_cut = false;                 ///< by the deadline: longer windows were not tried
};

/// Searches of the same structure in the same windows will not part any more.
void drop_when_agreed(Searches& searches) {
  const Matrix& found = searches.first.fit.coefficients;
  if (searches.second && have_same_terms(searches.second->fit.coefficients, found))
    searches.second.reset();
}

bool is_usable(const WindowFit& fit) {
  return fit.rows > 0 && !fit.subset.empty() && fit.coefficients.allFinite();
}

/// Whether another model does the same in windows no shorter, with fewer terms: the rms of a
/// state's residuals is known to 1 / sqrt(2 n) of it.
bool is_simpler(const WindowFit& other, const WindowFit& than) {
  if (!is_usable(other) || other.subset.size() >= than.subset.size()) return false;
  if (other.samples < than.samples) return false;
  const double scatter = 4.0 / std::sqrt(2.0 * static_cast<double>(other.rows));
  return (other.rms.array() <= (1.0 + scatter) * than.rms.array()).all();
}

/// Begins at a model, and where that leads to terms which plainer ones may stand for, at what
/// is found in those alone, too. The simpler model stays.
WindowSearch begun_at(const SearchTask& task, const std::optional<SearchTask>& plain,
                      const WindowSearch& prepared, const Matrix& start,
                      const RunContext& context) {
  WindowSearch found = begun(task, prepared, start, context);
  if (!plain || !has_other_terms(*plain, found.fit)) return found;
  const WindowFit fit = begun(*plain, prepared, start, context).fit;
  if (!is_usable(fit)) return found;
  WindowSearch other = begun(task, prepared, fit.coefficients, context);
  return is_simpler(other.fit, found.fit) ? other : found;
}

/// Searches in longer and longer windows, to the end.
/// @param settled what is found in the longest windows by now.
void search_longer(const SearchTask& task, Searches searches, Searches& settled,
                   const RunContext& context) {
  for (bool grows = true; grows;) {
    drop_when_agreed(searches);
    grows = grow(task, searches.first, context);
    if (searches.second && grow(task, *searches.second, context)) grows = true;
    settled = searches;
  }
  drop_when_agreed(searches);
  const auto complete = [&](WindowSearch& search) {
    take_all_windows(task, search, context);
    check_steps(task, search, context);
  };
  complete(searches.first);
  if (searches.second) complete(*searches.second);
  drop_when_agreed(searches);
  settled = searches;
  finish(searches.first, context);
  if (searches.second) finish(*searches.second, context);
  settled = std::move(searches);
}

/// Searches to the end, or to the deadline. The first one's fit has no rows when the records
/// are too short.
Searches search_windows(const SearchTask& task, const Matrix& start,
                        const TrajectorySelectionOptions& options, const RunContext& context) {
  const WindowSearch prepared = prepared_search(task, context);
  const std::optional<SearchTask> plain = plain_task(task, options.relation_strength, context);
  Searches searches{begun_at(task, plain, prepared, start, context), std::nullopt};
  if (options.second_opinion)
    searches.second =
        begun_at(task, plain, prepared, Matrix::Zero(start.rows(), start.cols()), context);
  if (searches.second && !is_usable(searches.first.fit)) {
    // A model that has no solution in the shortest windows is no start.
    searches.first = std::move(*searches.second);
    searches.second.reset();
  }
  if (searches.first.fit.rows == 0) return searches;
  try {
    search_longer(task, searches, searches, context);
  } catch (const OutOfTime&) {
    searches.is_cut = true;
  }
  return searches;
}

/// Half the usual gap: the first path is interpolated where a model would be carried on. With
/// ten steps Lorenz' equations (1 % noise, eight of each hundred samples missing) have smaller
/// errors at 150 samples a turn (28 x: 0.007 instead of 0.016) and are lost at 25 samples a
/// turn.
constexpr GapOptions kGaps{.longest_gap = 5.0};

/// The records without gaps that can be bridged; of long ones stretches that stand for them.
Dataset stretches_of(const Dataset& data, int threads) {
  Dataset joined = join_across_gaps(data, kGaps);
  if (joined.samples() <= 2 * kMostSamples) return joined;
  const Trajectory& longest = longest_record(joined);
  Dataset begin{joined.time_unit, joined.states,       joined.inputs, {},
                joined.rate_of,   joined.reconstructed};
  begin.trajectories.push_back(rows_of(longest, 0, std::min(kMostSamples, longest.samples())));
  return record_stretches(joined, kMostSamples, first_window(begin, threads));
}

/// What is known of the noise of a task's records.
std::optional<Vector> white_noise_of(const RefinerTask& task) {
  return task.noise ? std::optional(white_noise(*task.noise)) : std::nullopt;
}

void note_length(const Dataset& whole, const Dataset& part, std::vector<std::string>& notes) {
  notes.push_back("refined in " + std::to_string(part.trajectories.size()) +
                  " stretches of the record, " + std::to_string(part.samples()) + " of " +
                  std::to_string(whole.samples()) +
                  " samples: more would not change the terms");
}

void note_negligible(const std::vector<LeftOut>& left_out, const TermLibrary& library,
                     RefinedModel& result) {
  for (const LeftOut& out : left_out)
    result.negligible.push_back(
        {out.column.equation, library.terms[static_cast<std::size_t>(out.column.term)].name(),
         out.effect, out.threshold});
}

/// The model of the stages before; where it needs no fit there is nothing to warn of.
RefinedModel as_it_was(RefinedModel same, bool needs_no_fit) {
  if (needs_no_fit) same.message.clear();
  return same;
}

/// The model that a search has when its time is over.
RefinedModel as_far_as_it_came(const RefinerTask& task, const SearchTask& search,
                               const WindowFit& fit) {
  RefinedModel result = Outcome(task, fit, search.noise).make();
  result.notes.push_back("refined in windows of " + std::to_string(fit.samples) +
                         " samples when the time was over: longer ones may determine terms and "
                         "coefficients better");
  return result;
}

}  // namespace

RefinedModel TrajectorySelection::do_refine(const RefinerTask& task,
                                            const RunContext& context) const {
  if (task.start.is_map())
    throw ConfigError("refiner trajectory", "it fits flows, and the model is a map",
                      "take the refiner none, as --discrete does");
  const bool from_model = options().start == TrajectorySelectionOptions::Start::Model;
  Dataset data = stretches_of(task.data, context.threads);
  const bool is_long = data.samples() < task.data.samples() / 2;
  const bool is_whole = data.trajectories.size() == task.data.trajectories.size() &&
                        data.samples() == task.data.samples();
  const std::vector<StateNoise> noise =
      known_or_analysed(is_whole ? task.noise : std::nullopt, data, context.threads);
  RefinedModel same{.model = task.start, .usable = false};
  same.message = reason_to_leave(task, noise, from_model);
  if (!same.message.empty()) return as_it_was(std::move(same), from_model);
  Matrix start = coefficients_of(task.start, task.library);
  if (!from_model) start.setZero();
  const SearchTask search =
      search_task(std::move(data), {task.library, task.allowed, task.constraints}, noise,
                  options(), context.threads);
  auto [found, other, is_cut] = search_windows(search, start, options(), context);
  same.message = "no windows of the record could be fitted";
  if (!is_usable(found.fit)) return same;
  if (is_cut) return as_far_as_it_came(task, search, found.fit);
  std::vector<LeftOut> left_out =
      leave_out_negligible(search, found, options().negligible, context);
  if (other) {
    std::vector<LeftOut> others =
        leave_out_negligible(search, *other, options().negligible, context);
    if (is_simpler(other->fit, found.fit)) {
      std::swap(found, *other);
      left_out = std::move(others);
    }
  }
  RefinedModel result = Outcome(task, found.fit, search.noise).make();
  const bool is_noise = fits_to_noise(result);
  // A model that breaks down in longer windows is an approximation; no noise does that.
  if (!is_noise && found.limited) {
    const std::vector<LeftOut> more =
        leave_out_negligible(search, found, options().negligible.beside_a_floor(), context);
    left_out.insert(left_out.end(), more.begin(), more.end());
    constexpr double kSlack = 0.1;  // the residuals of an approximation are not known better
    simplify(search, found, kSlack, context);
    result = Outcome(task, found.fit, search.noise).make();
  }
  if (from_model && start.isZero())
    result.notes.push_back("the stages before found no term; the search began from nothing");
  if (!is_noise && options().refit && task.constraints.empty())
    if (std::optional<OdeModel> model =
            is_long ? refitted(result.model, search.data, white_noise(search.seen), context)
                    : refitted(result.model, task.data, white_noise_of(task), context))
      result.model = std::move(*model);
  if (is_long) note_length(task.data, search.data, result.notes);
  if (other) note_disputes(task, found.fit, other->fit, result.notes);
  note_growing_noise(search, result.notes);
  note_negligible(left_out, task.library, result);
  return result;
}

Stage<Refiner> trajectory_selection(const TrajectorySelectionOptions& options) {
  return TrajectorySelection(options);
}

}  // namespace lacuna
