// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/synchroniser.hpp"

#include <algorithm>

#include "core/base/random.hpp"
#include "core/numerics/lagrange.hpp"
#include "data/records/known_noise.hpp"
#include "data/records/number_range.hpp"
#include "dynamics/integration/automatic.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "slave.hpp"
#include "slave_probes.hpp"
#include "sync_errors.hpp"

namespace lacuna {
namespace {

void check_shapes(const OdeModel& model, const SyncOptions& options) {
  const Index m = model.dimension();
  if (options.coupling && (options.coupling->rows() != m || options.coupling->cols() != m))
    throw ArgumentError("synchronisation, coupling",
                        "K is not " + std::to_string(m) + " x " + std::to_string(m),
                        "give one row and one column per state of the model");
  if (options.start && options.start->size() != m)
    throw ArgumentError("synchronisation, start",
                        "it has " + std::to_string(options.start->size()) + " values for " +
                            std::to_string(m) + " states",
                        "give one value per state of the model");
}

void check_lengths(const Dataset& record, Index needed) {
  if (record.trajectories.empty())
    throw DataError("synchronisation", "the record has no trajectory", "give at least one");
  for (const Trajectory& trajectory : record.trajectories) {
    if (trajectory.samples() >= needed) continue;
    throw DataError(trajectory.source,
                    "it has " + std::to_string(trajectory.samples()) +
                        " samples; to synchronise by this integrator needs " +
                        std::to_string(needed),
                    "use a longer record or an integrator of lower order");
  }
}

/// 1 for each state of the slave that the record shows.
Vector seen_states(const Dataset& view) {
  Vector seen = Vector::Ones(view.state_count());
  for (Index k = 0; k < seen.size(); ++k)
    if (is_hidden(view, k)) seen[k] = 0.0;
  return seen;
}

/// K as it was given, or made for this record.
/// @throws ArgumentError where it couples a state that nobody measured.
Matrix coupling_of(const OdeModel& model, const Dataset& view, const Vector& seen,
                   const std::optional<Matrix>& given) {
  if (!given) return default_coupling(view) * seen.asDiagonal();
  for (Index k = 0; k < seen.size(); ++k)
    if (seen[k] == 0.0 && !given->col(k).isZero(0.0))
      throw ArgumentError("synchronisation, coupling",
                          "nobody measured the state '" +
                              model.states()[static_cast<std::size_t>(k)].name + "'",
                          "couple states that have a column");
  return *given;
}

void check_delays(const OdeModel& model, const Vector& seen) {
  const CompiledModel compiled = model.compile();
  for (const DelayedVariable& variable : compiled.delays())
    if (variable.slot < seen.size() && seen[variable.slot] == 0.0)
      throw ModelError("synchronisation",
                       "the past of the hidden state '" +
                           model.states()[static_cast<std::size_t>(variable.slot)].name +
                           "' is not known",
                       "measure it, or leave its delay out");
}

std::string divergence_message(const Trajectory& trajectory, const SlaveRun& run,
                               const OdeModel& model, const std::string& time_unit) {
  const bool is_stuck = run.status == IntegrationStatus::StepTooSmall;
  return trajectory.source + ": the slave " + (is_stuck ? "cannot go on, " : "") +
         end_message(run.status, run.end_time, run.end_state, names_of(model.states()),
                     time_unit);
}

/// What a slave that came to the end leaves open: other slaves show it.
void probe(const SlaveTask& task, const Dataset& view, SyncResult& result) {
  run_stage(result.stages, "response to noise",
            [&] { result.response = response_to_noise(task, view, result); });
  result.error_over_noise = error_over_noise(view, result);
  run_stage(result.stages, "response to the first sample",
            [&] { result.start_response = response_to_start(task, view, result); });
  if (result.status == IntegrationStatus::Completed && task.integrator.has_fixed_steps())
    run_stage(result.stages, "errors of the steps",
              [&] { result.step_errors = step_errors(task, view, result); });
  if (task.seen.minCoeff() == 0.0)
    run_stage(result.stages, "hidden states", [&] {
      result.conditional_exponent =
          conditional_exponent(task, view.trajectories.front(), result);
    });
}

/// The slaves of all trajectories and what they show.
/// @throws OutOfTime where the deadline passes before they are at the end.
SyncResult driven(const SlaveTask& task, const Dataset& view, const Vector& noise) {
  SyncResult result;
  result.coupling = task.coupling;
  result.noise = noise;
  for (const Trajectory& trajectory : view.trajectories) {
    SlaveRun run = run_slave(task, trajectory, start_of(task, trajectory));
    if (run.status != IntegrationStatus::Completed && result.message.empty()) {
      result.status = run.status;
      result.message = divergence_message(trajectory, run, task.model, view.time_unit);
    }
    result.errors.push_back(std::move(run.errors));
    result.states.push_back(std::move(run.states));
  }
  add_statistics(view, result);
  result.settled = has_settled(view, result);
  result.stages.push_back({"slaves"});
  result.response = result.start_response = Vector::Zero(view.state_count());
  probe(task, view, result);
  return result;
}

/// The noise of a view of a record: known where it has the states of the record.
Vector noise_in(const Dataset& view, const Dataset& record,
                const std::optional<Vector>& known) {
  const bool same = names_of(view.states) == names_of(record.states);
  return known_or_estimated(same ? known : std::nullopt, view);
}

/// Steps for slaves that are faster than the samples: the record between its samples is known
/// to no more than these tolerances, and what takes more steps has run away.
AutomaticOptions stiff_steps(const Dataset& view) {
  // Facts of the interpolation: a record is known no better between its samples.
  constexpr double kRelative = 1e-6, kAbsolute = 1e-9;
  constexpr int kMostSteps = 1000;
  const double absolute = std::max(kAbsolute * largest_norm(view), 1e-300);
  return {{.relative_tolerance = kRelative,
           .absolute_tolerance = absolute,
           .max_steps = kMostSteps}};
}

bool is_automatic(const Integrator& integrator) {
  return integrator.info().name == AutomaticOptions::kInfo.name;
}

/// Slaves by steps that adapt, and where these get too small by fixed ones, where the first
/// broke off or are faster than the samples; nothing where it stands, or nothing else gets
/// farther.
std::optional<SyncResult> by_other_steps(const SlaveTask& task, const Dataset& view,
                                         const Vector& noise, const SyncResult& first) {
  const bool adapts = !task.integrator.has_fixed_steps();
  if (first.status == IntegrationStatus::Completed &&
      !(adapts && is_faster_than_samples(task, view)))
    return std::nullopt;
  const auto by = [&](const Integrator& integrator) {
    // The fewer samples, the less a curve overshoots between them.
    const LagrangeWindow plain = adapts ? LagrangeWindow::driving(Rk4{}.order()) : task.window;
    return driven(
        {task.model, task.coupling, integrator, plain, task.start, task.seen, task.context},
        view, noise);
  };
  SyncResult finer = by(Automatic(stiff_steps(view)));
  if (finer.status == IntegrationStatus::Completed) {
    finer.stiff = true;
    return finer;
  }
  if (first.status != IntegrationStatus::StepTooSmall || !is_automatic(task.integrator))
    return std::nullopt;
  SyncResult coarser = by(Rk4{});
  if (coarser.status != IntegrationStatus::Completed) return std::nullopt;
  coarser.by_fixed_steps = true;
  return coarser;
}

}  // namespace

Dataset long_enough(Dataset record, const Integrator& integrator) {
  const Index needed = LagrangeWindow::driving(integrator.order()).points;
  std::vector<Trajectory>& all = record.trajectories;
  const auto too_short = std::stable_partition(
      all.begin(), all.end(),
      [&](const Trajectory& trajectory) { return trajectory.samples() >= needed; });
  const auto count = all.end() - too_short;
  if (count == 0 || too_short == all.begin()) return record;
  all.erase(too_short, all.end());
  record.notes.push_back(std::to_string(count) + " pieces of less than " +
                         std::to_string(needed) + " samples were left out");
  return record;
}

SyncResult synchronise(const OdeModel& model, const Dataset& record,
                       const Integrator& integrator, const SyncOptions& options,
                       const RunContext& context) {
  check_flow(model, "synchronise");
  check_no_events(model, "synchronise");
  check_dataset(record);
  check_known(options.noise, record, "synchronise");
  check_shapes(model, options);
  const LagrangeWindow window = LagrangeWindow::driving(integrator.order());
  const Dataset view = model_view(model, record);
  check_number_range(view);
  check_lengths(view, window.points);
  const Vector seen = seen_states(view);
  check_delays(model, seen);
  const Matrix coupling = coupling_of(model, view, seen, options.coupling);
  const Vector noise = noise_in(view, record, options.noise);
  const SlaveTask task{model, coupling, integrator, window, options.start, seen, context};
  SyncResult result = driven(task, view, noise);
  std::optional<SyncResult> other;
  if (run_stage(result.stages, "other steps",
                [&] { other = by_other_steps(task, view, noise, result); }) &&
      other)
    return *std::move(other);
  return result;
}

}  // namespace lacuna
