// SPDX-License-Identifier: MIT
#include "free_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/integration/automatic.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "model/equations/formula_channel.hpp"

namespace lacuna {
namespace {

// Facts of the comparison. Two runs are together while they are nearer than this fraction of a
// deviation; starts are off by the noise, and by so much at least; longer records show no more.
constexpr double kTogether = 0.3, kLeastOff = 1e-3;
// A thousandth of that is enough of an integration; at rest under dry friction, where steps
// would get shorter with the tolerance without end, a hundredth of a sampling interval is.
constexpr double kAccuracy = 1e-3 * kLeastOff, kAlongJump = 1e-2;
constexpr Index kMostSamples = 10000;

/// The states of a model that have rates: channels that are formulas of these have none.
std::vector<Index> states_with_rates(const OdeModel& model) {
  std::vector<Index> states;
  for (Index k = 0; k < model.dimension(); ++k)
    if (!is_formula_channel(model.states()[static_cast<std::size_t>(k)])) states.push_back(k);
  return states;
}

OdeModel with_rates_only(const OdeModel& model, const std::vector<Index>& kept) {
  std::vector<Quantity> states;
  std::vector<Equation> equations;
  for (const Index k : kept) {
    states.push_back(model.states()[static_cast<std::size_t>(k)]);
    equations.push_back(model.equations()[static_cast<std::size_t>(k)]);
  }
  return OdeModel(std::move(states), model.inputs(), std::move(equations), model.time_unit());
}

/// Values of a formula channel along a run.
Vector channel_along(const OdeModel& model, Index channel, const OdeModel& own,
                     const Matrix& states, const Trajectory& part) {
  Vector sum = Vector::Zero(states.rows());
  for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(channel)]) {
    const Program program({&summand.term.expression(), 1}, own.variables());
    if (!program.delays().empty())
      return Vector::Constant(states.rows(), std::numeric_limits<double>::quiet_NaN());
    Matrix slots(states.rows(), program.slots()), value(states.rows(), 1);
    slots << states, part.inputs, part.time;
    Program::Workspace workspace;
    program.evaluate(slots, value, workspace);
    sum += summand.coefficient * value.col(0);
  }
  return sum;
}

/// A run as far as it has come, and whether it grew beyond bounds there: where no step is small
/// enough (a state that a sign holds in its jump) it ends too, and runs nowhere.
struct FreeRun {
  Matrix states;
  bool diverged = false;
};

/// How runs are integrated: errors of a step are small beside what starts are off.
Automatic integrator_for(const FreeRunTask& task) {
  double least = 1.0;
  for (const double scale : task.scale)
    if (scale > 0.0) least = std::min(least, scale);
  return Automatic({.control = {.relative_tolerance = kAccuracy,
                                .absolute_tolerance = kAccuracy * least,
                                .along_jump = kAlongJump}});
}

/// A run over part of a record, of whose inputs all are known: all states of the model.
FreeRun run_of(const FreeRunTask& task, const std::vector<Index>& kept, const Vector& start,
              const Trajectory& whole, const Trajectory& part, const RunContext& context) {
  const OdeModel& model = task.model;
  const OdeModel own = with_rates_only(model, kept);
  RecordInput input(whole, own.inputs());
  const auto signal = [&](double t, double* u) { input(t, u); };
  const Solution run = simulate(DrivenModel{own, signal, input.breaks()}, integrator_for(task),
                                Vector(start(kept)), part.time, context);
  const Index rows = run.states.rows();
  Matrix all(rows, model.dimension());
  for (std::size_t i = 0; i < kept.size(); ++i)
    all.col(kept[i]) = run.states.col(static_cast<Index>(i));
  Trajectory reached = part;
  reached.time = part.time.head(rows).eval();
  reached.inputs = part.inputs.topRows(rows).eval();
  for (Index k = 0; k < model.dimension(); ++k)
    if (is_formula_channel(model.states()[static_cast<std::size_t>(k)]))
      all.col(k) = channel_along(model, k, own, run.states, reached);
  return {std::move(all), run.status == IntegrationStatus::Diverged};
}

/// The states by which runs are compared: measured ones that move.
std::vector<Index> compared_states(const FreeRunTask& task) {
  std::vector<Index> states;
  for (Index k = 0; k < task.records.state_count() && k < task.scale.size(); ++k)
    if (task.noise.measurement[static_cast<std::size_t>(k)] && task.scale[k] > 0.0)
      states.push_back(k);
  return states;
}

/// Samples of both runs up to which they are together.
Index together(const Matrix& run, const Matrix& nearby, const FreeRunTask& task) {
  const Index rows = std::min(run.rows(), nearby.rows());
  const std::vector<Index> states = compared_states(task);
  for (Index i = 0; i < rows; ++i)
    for (const Index k : states)
      if (!(std::abs(run(i, k) - nearby(i, k)) <= kTogether * task.scale[k])) return i;
  return rows;
}

/// A start next to another one.
Vector next_to(const Vector& start, const FreeRunTask& task) {
  Vector moved = start;
  for (Index k = 0; k < start.size(); ++k) {
    const bool known = k < task.scale.size();
    const auto at = static_cast<std::size_t>(k);
    const double noise = at < task.noise.measurement.size() && task.noise.measurement[at]
                             ? task.noise.rounded(at)
                             : 0.0;
    const double size = known ? task.scale[k] : std::abs(start[k]);
    moved[k] += (k % 2 == 0 ? 1.0 : -1.0) * std::max(noise, kLeastOff * size);
  }
  return moved;
}

/// Samples from one on of which all inputs are known.
Index known_inputs(const Trajectory& record, Index begin) {
  Index end = begin;
  while (end < record.samples() && record.inputs.row(end).allFinite()) ++end;
  return end - begin;
}

Trajectory part_from(const Trajectory& record, Index begin) {
  const Index n = std::min(kMostSamples, known_inputs(record, begin));
  Trajectory part;
  part.source = record.source;
  part.time = record.time.segment(begin, n);
  part.states = record.states.middleRows(begin, n);
  part.inputs = record.inputs.middleRows(begin, n);
  if (record.marks.size() > 0) part.marks = record.marks.middleRows(begin, n);
  return part;
}

/// Squares of what a run is off, and how many there are.
struct Squares {
  double sum = 0.0, count = 0.0;
};

Squares squares_of(const Matrix& run, Index rows, const Trajectory& part,
                   const FreeRunTask& task) {
  Squares squares;
  for (const Index k : compared_states(task))
    for (Index i = 0; i < rows; ++i) {
      if (mark_of(part.marks, i, k) != Mark::Value) continue;
      squares.sum += std::pow((part.states(i, k) - run(i, k)) / task.scale[k], 2);
      ++squares.count;
    }
  return squares;
}

}  // namespace

std::optional<RunApart> run_freely(const FreeRunTask& task, Index least,
                                   const RunContext& context) {
  context.report("running the model freely over the records not used before", 0.0);
  const std::vector<Index> kept = states_with_rates(task.model);
  Squares all;
  RunApart result;
  for (std::size_t r = 0; r < task.records.trajectories.size(); ++r) {
    const Trajectory& whole = task.records.trajectories[r];
    const Trajectory part = part_from(whole, task.begins[r]);
    const Vector start = task.paths[r].row(task.begins[r]).transpose();
    if (!start.allFinite() || part.samples() < least) continue;
    const FreeRun run = run_of(task, kept, start, whole, part, context);
    const FreeRun nearby = run_of(task, kept, next_to(start, task), whole, part, context);
    const Index rows = together(run.states, nearby.states, task);
    if (run.diverged && rows == run.states.rows()) all.sum = INFINITY;
    if (rows < std::min(least, run.states.rows())) continue;
    const Squares squares = squares_of(run.states, rows, part, task);
    if (rows == 0) continue;
    all.sum += squares.sum;
    all.count += squares.count;
    result.duration = std::max(result.duration, part.time[rows - 1] - part.time[0]);
  }
  if (!(all.count > 0.0)) return std::nullopt;
  result.apart = std::sqrt(all.sum / all.count);
  return result;
}

}  // namespace lacuna
