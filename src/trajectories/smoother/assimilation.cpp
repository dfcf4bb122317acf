// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/assimilation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "assimilation_steps.hpp"
#include "core/numerics/least_squares.hpp"
#include "data/records/check_record.hpp"
#include "data/records/state_statistics.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "model/equations/formula_channel.hpp"
#include "trajectories/smoother/innovation_system.hpp"
#include "trajectories/smoother/variance_fit.hpp"

namespace lacuna {
namespace {

double coefficient_at(const OdeModel& model, const CoefficientPlace& place) {
  return model
      .equations()[static_cast<std::size_t>(place.equation)]
                  [static_cast<std::size_t>(place.term)]
      .coefficient;
}

/// Where states are hidden a step may be far from what it promises: what counts is the deviance
/// that is found where the steps have led.
Assimilation verified(const AssimilationTask& task, Assimilation state,
                      VarianceFit& variances) {
  // A fact of the search: steps that are far from what they promise are few.
  constexpr int kPasses = 3;
  state = relinearised(task, std::move(state));
  std::optional<Assimilation> best;
  for (int pass = 0; pass < kPasses; ++pass) {
    const InnovationSystem system(state);
    state.deviance = system.deviance();
    state.used = system.used();
    if (best && std::isfinite(best->deviance) && !(state.deviance < best->deviance)) break;
    best = state;
    if (pass + 1 == kPasses) break;
    const std::vector<Matrix> before = paths_of(state);
    state =
        relinearised_in_reach(task, with_noise_and_path(std::move(state), variances), before);
  }
  return std::move(*best);
}

/// One turn at noise, path and coefficients.
Assimilation after_turn(const AssimilationTask& task, Assimilation state,
                        VarianceFit& variances) {
  if (task.options.hidden.empty())
    state = relinearised(task, with_noise_and_path(std::move(state), variances));
  else {
    const std::vector<Matrix> before = paths_of(state);
    state =
        relinearised_in_reach(task, with_noise_and_path(std::move(state), variances), before);
  }
  return with_fitted_coefficients(task, std::move(state));
}

/// Takes turns until the deviance falls no more.
/// @param fresh whether the variances are first guesses: the noise of the measurement is known
/// roughly from the start, the disturbances are not, and the first turns settle these.
Assimilation after_turns(const AssimilationTask& task, Assimilation state, bool fresh,
                         const RunContext& context) {
  // A fact of the search.
  constexpr int kSettlingTurns = 2;
  // Turns that raise the deviance before they are given up; the linearisation need not hold for
  // a long first step.
  constexpr int kRises = 2;
  VarianceFit variances(state.least_noise, state.curvature);
  double last = std::numeric_limits<double>::infinity();
  std::optional<Assimilation> best;
  int rises = 0;
  if (!fresh) state = with_fitted_coefficients(task, std::move(state));
  for (int turn = 0; turn < task.options.passes; ++turn) {
    context.check_stop();
    const bool settling = fresh && turn < kSettlingTurns;
    variances.set_white_moves(!settling);
    state = after_turn(task, std::move(state), variances);
    if (std::isnan(state.deviance)) break;  // no turn comes back from a path that is lost
    if (settling) continue;
    if (state.deviance < last - kUnnoticedDeviance) {
      last = state.deviance;
      best = state;
      continue;
    }
    if (std::abs(state.deviance - last) <= kUnnoticedDeviance || ++rises > kRises) break;
  }
  if (best && !(state.deviance < best->deviance + kUnnoticedDeviance)) state = std::move(*best);
  return task.options.hidden.empty() ? state : verified(task, std::move(state), variances);
}

/// The maximum of the likelihood that is found from a start.
Assimilation assimilated(const AssimilationTask& task, Assimilation state, bool fresh,
                         const RunContext& context) {
  state.least_noise = resolution_of(task.data);
  // A fact of the filter: below this fraction of a lattice noise makes no difference to what
  // its values say, and their probabilities lose their digits.
  constexpr double kFractionOfLattice = 0.05;
  for (Index k = 0; k < state.least_noise.size(); ++k)
    state.least_noise[k] =
        std::max(state.least_noise[k],
                 kFractionOfLattice * state.noise.lattice_of(static_cast<std::size_t>(k)));
  state = relinearised(task, std::move(state));
  // A guessed path may lie where the model has no slope, as the root of an empty tank.
  if (!task.options.hidden.empty() && !is_linearised(state)) {
    state.deviance = std::numeric_limits<double>::infinity();
    return state;
  }
  return after_turns(task, std::move(state), fresh, context);
}

/// Whether an equation holds exactly: an identity, or the formula of a channel.
bool is_exact(const OdeModel& model, Index equation) {
  return is_formula_channel(model.states()[static_cast<std::size_t>(equation)]) ||
         identity_of(model, equation).has_value();
}

/// Whether nothing disturbs an equation to begin with. One without terms that stands for a
/// state which nobody measured says what that state is: a constant.
bool is_undisturbed(const OdeModel& model, const Dataset& data, Index equation) {
  return is_exact(model, equation) ||
         (!data.is_measured(equation) &&
          model.equations()[static_cast<std::size_t>(equation)].empty());
}

/// Variances to begin with: noise as the differences of the record show it, disturbances as if
/// the model explained half of each rate.
NoiseModel first_noise(const OdeModel& model, const Dataset& data, const Vector& seen,
                       const AssimilationOptions& options) {
  const Vector white = resolution_of(data).cwiseMax(seen);
  const Trajectory& record = data.trajectories.front();
  const double step = mean_step(record);
  NoiseModel noise;
  noise.coloured = options.coloured;
  noise.coloured.resize(static_cast<std::size_t>(model.dimension()));
  noise.disturbance = Vector::Zero(model.dimension());
  for (Index k = 0; k < model.dimension(); ++k) {
    const auto measured = data.is_measured(k) ? std::optional(white[k]) : std::nullopt;
    noise.measurement.push_back(measured);
    const bool disturbed = options.disturbed ? (*options.disturbed)[static_cast<std::size_t>(k)]
                                             : !is_undisturbed(model, data, k);
    const Vector change = record.states.col(k).tail(record.samples() - 1) -
                          record.states.col(k).head(record.samples() - 1);
    double moved = 0.1 * std::sqrt(change.squaredNorm() / static_cast<double>(change.size()));
    // A channel that never moves says nothing of what disturbs it, which is not nothing.
    if (moved == 0.0 && measured) moved = *measured;
    if (disturbed) noise.disturbance[k] = moved / std::sqrt(step);
  }
  return noise;
}

}  // namespace

Vector resolution_of(const Dataset& data) {
  check_states(data, "resolution_of");
  check_argument(data.samples() > 0, "resolution_of", "there is no sample");
  // Text with six digits, the least that is in use, leaves steps of 1e-6 of the span; of a
  // channel that never moves, of its value.
  Vector sizes = state_spans(data);
  const Vector values = data.trajectories.front().states.row(0).cwiseAbs().transpose();
  for (Index k = 0; k < sizes.size(); ++k)
    if (sizes[k] <= std::numeric_limits<double>::min())
      sizes[k] = values[k] > 0.0 ? values[k] : 1.0;
  return 1e-7 * sizes;
}

std::vector<CoefficientPlace> free_coefficients(const OdeModel& model) {
  std::vector<CoefficientPlace> places;
  for (Index k = 0; k < model.dimension(); ++k) {
    if (is_exact(model, k)) continue;
    const Equation& equation = model.equations()[static_cast<std::size_t>(k)];
    for (std::size_t j = 0; j < equation.size(); ++j)
      if (!equation[j].fixed) places.push_back({k, static_cast<Index>(j)});
  }
  return places;
}

Vector sizes_of(const Assimilation& fit, std::size_t count) {
  Vector size = Vector::Zero(static_cast<Index>(fit.free.size() + fit.channel_terms.size()));
  for (std::size_t j = 0; j < count && j < fit.free.size(); ++j)
    size[static_cast<Index>(j)] = coefficient_at(fit.model, fit.free[j]);
  return size;
}

void add_priors(const Assimilation& fit, const std::vector<CoefficientPrior>& priors,
                Matrix& normal, Vector& right) {
  for (const CoefficientPrior& prior : priors)
    for (std::size_t j = 0; j < fit.free.size(); ++j) {
      if (!(fit.free[j] == prior.place)) continue;
      const auto row = static_cast<Index>(j);
      const double weight = 1.0 / (prior.deviation * prior.deviation);
      normal(row, row) += weight;
      right[row] += weight * (prior.mean - coefficient_at(fit.model, prior.place));
    }
}

Matrix without_channel_terms(Matrix measured, const LinearisedRecord& record,
                             const Variables& variables,
                             const std::vector<ChannelTerm>& terms) {
  for (const ChannelTerm& term : terms)
    measured.col(term.state) -=
        term.coefficient * evaluate_on(record, variables, term.form)(record.sample_rows());
  return measured;
}

std::optional<Assimilation> with_estimated_noise(const Assimilation& fit) {
  // A decision (docs/decisions.md).
  constexpr double kFractionOfEstimatedNoise = 0.3;
  Assimilation start = fit;
  bool raised = false;
  for (Index k = 0; k < fit.estimated_noise.size(); ++k) {
    auto& white = start.noise.measurement[static_cast<std::size_t>(k)];
    if (!white || *white >= kFractionOfEstimatedNoise * fit.estimated_noise[k]) continue;
    white = fit.estimated_noise[k];
    raised = true;
  }
  return raised ? std::optional(std::move(start)) : std::nullopt;
}

Assimilation settled(Assimilation found, const Dataset& data,
                     const AssimilationOptions& options, const RunContext& context) {
  const auto start = with_estimated_noise(found);
  if (!start) return found;
  Assimilation other = assimilate_from(found.model, data, *start, options, context);
  return other.deviance < found.deviance ? other : found;
}

Assimilation assimilate(const OdeModel& model, const BoundRecords& records,
                        const AssimilationOptions& options, const RunContext& context) {
  const auto& [data, channels, outliers, notes] = records;
  Assimilation start{model};
  start.omitted = outliers;
  start.estimated_noise = visible_noise(records);
  start.noise = first_noise(model, data, start.estimated_noise, options);
  start.noise.lattice = coarse_lattices(records);
  for (std::size_t r = 0; r < data.trajectories.size(); ++r) {
    const Matrix& states = data.trajectories[r].states;
    start.records.emplace_back();
    start.records.back().path = outliers.empty() ? states : filled(states, outliers[r]);
    start.measured.push_back(states);
  }
  start.free = options.free;
  return settled(assimilated({data, options}, std::move(start), true, context), data, options,
                 context);
}

Assimilation assimilate_from(const OdeModel& model, const Dataset& data,
                             const Assimilation& start, const AssimilationOptions& options,
                             const RunContext& context) {
  Assimilation begin = start;
  begin.model = model;
  begin.free = options.free;
  begin.measured.clear();
  for (const Trajectory& record : data.trajectories) begin.measured.push_back(record.states);
  return assimilated({data, options}, std::move(begin), false, context);
}

}  // namespace lacuna
