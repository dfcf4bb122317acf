// SPDX-License-Identifier: MIT
#include "shooting_record.hpp"

#include <algorithm>
#include <string>

#include "lacuna/core/error.hpp"
#include "lacuna/dynamics/record_input.hpp"
#include "lacuna/records/gaps.hpp"

namespace lacuna {
namespace {

std::optional<Index> find(const std::vector<Quantity>& quantities, const std::string& name) {
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (quantities[i].name == name) return static_cast<Index>(i);
  return std::nullopt;
}

std::vector<Index> input_columns(const ParametrisedModel& model, const Dataset& record) {
  std::vector<Index> columns;
  for (Index i = 0; i < model.record_inputs(); ++i) {
    const std::string& name = model.symbolic().inputs()[static_cast<std::size_t>(i)].name;
    const std::optional<Index> column = find(record.inputs, name);
    if (!column)
      throw DataError("record", "it has no input '" + name + "', which the model has",
                      "name the columns as in the model or choose them with the data options");
    columns.push_back(*column);
  }
  return columns;
}

/// Record signals of one trajectory as functions of time.
class TrajectorySignals {
 public:
  TrajectorySignals(const ShootingRecord& record, Index trajectory, const Rates& rates)
      : record_(record),
        delays_(rates.delays()),
        dimension_(rates.dimension()),
        first_(record.begins[static_cast<std::size_t>(trajectory)]),
        count_(record.begins[static_cast<std::size_t>(trajectory) + 1] - first_),
        values_(signal(record.values)),
        inputs_(signal(record.inputs)),
        value_scratch_(record.values.cols()),
        input_scratch_(record.inputs.cols()) {
    for (const DelayedVariable& delay : delays_) check(delay);
  }

  /// Writes (inputs, t, delayed variables) to one row.
  void write(double t, Matrix& out, Index row) {
    const Index p = record_.inputs.cols();
    if (p > 0) {
      inputs_(t, input_scratch_.data());
      out.row(row).head(p) = input_scratch_;
    }
    out(row, p) = t;
    for (std::size_t i = 0; i < delays_.size(); ++i)
      out(row, p + 1 + static_cast<Index>(i)) = delayed(delays_[i], t - delays_[i].delay);
  }

 private:
  RecordInput signal(const Matrix& columns) const {
    return {record_.time.segment(first_, count_), columns.middleRows(first_, count_),
            std::min<Index>(4, count_)};
  }

  void check(const DelayedVariable& delay) const {
    const bool is_state = delay.slot < dimension_;
    if (is_state ? record_.rows[static_cast<std::size_t>(delay.slot)].has_value()
                 : delay.slot < dimension_ + record_.inputs.cols())
      return;
    throw DataError("record", "a delayed variable of the model was not measured",
                    "delay measured states and inputs only");
  }

  double delayed(const DelayedVariable& delay, double t) {
    if (delay.slot < dimension_) {
      values_(t, value_scratch_.data());
      return value_scratch_[*record_.rows[static_cast<std::size_t>(delay.slot)]];
    }
    inputs_(t, input_scratch_.data());
    return input_scratch_[delay.slot - dimension_];
  }

  const ShootingRecord& record_;
  const std::vector<DelayedVariable>& delays_;
  Index dimension_, first_, count_;
  RecordInput values_, inputs_;
  Vector value_scratch_, input_scratch_;
};

void write_step(TrajectorySignals& source, double t, double h, Index step,
                StageSignals& signals) {
  signals.lengths[step] = h;
  for (std::size_t a = 0; a < signals.stages.size(); ++a)
    source.write(t + signals.scheme.tableau->nodes[a] * h, signals.stages[a], step);
}

void write_trajectory(const ShootingRecord& record, const Rates& rates, Index trajectory,
                      StageSignals& signals) {
  TrajectorySignals source(record, trajectory, rates);
  const Index substeps = signals.scheme.substeps;
  const Index begin = record.begins[static_cast<std::size_t>(trajectory)];
  const Index last = record.begins[static_cast<std::size_t>(trajectory) + 1] - 1;
  for (Index i = begin; i <= last; ++i) {
    const double interval = i < last ? record.time[i + 1] - record.time[i] : 0.0;
    const double h = interval / static_cast<double>(substeps);
    for (Index j = 0; j < substeps; ++j)
      write_step(source, record.time[i] + static_cast<double>(j) * h, h, i * substeps + j,
                 signals);
  }
}

}  // namespace

ShootingRecord shooting_record(const ParametrisedModel& model, const Dataset& pieces) {
  const Dataset data = join_across_gaps(pieces);
  ShootingRecord record;
  std::vector<Index> columns;
  for (const Quantity& state : model.symbolic().states()) {
    const std::optional<Index> column = find(data.states, state.name);
    record.rows.push_back(column ? std::optional(static_cast<Index>(columns.size()))
                                 : std::nullopt);
    if (!column) continue;
    record.measured.push_back(static_cast<Index>(record.rows.size()) - 1);
    columns.push_back(*column);
  }
  if (columns.empty())
    throw DataError("record", "it has no column for any state of the model",
                    "name the columns as in the model");
  const std::vector<Index> inputs = input_columns(model, data);
  const Index samples = data.samples();
  record.time.resize(samples);
  record.values.resize(samples, static_cast<Index>(columns.size()));
  record.inputs.resize(samples, static_cast<Index>(inputs.size()));
  record.begins = {0};
  for (const Trajectory& run : data.trajectories) {
    const Index first = record.begins.back(), n = run.samples();
    record.time.segment(first, n) = run.time;
    record.values.middleRows(first, n) = run.states(Eigen::all, columns);
    if (!inputs.empty()) record.inputs.middleRows(first, n) = run.inputs(Eigen::all, inputs);
    record.begins.push_back(first + n);
  }
  return record;
}

StageSignals stage_signals(const ShootingRecord& record, const Rates& rates,
                           const StepScheme& scheme) {
  const Index steps = record.samples() * scheme.substeps;
  StageSignals signals{scheme, Vector::Zero(steps),
                       std::vector<Matrix>(static_cast<std::size_t>(scheme.tableau->stages()),
                                           Matrix::Zero(steps, rates.signals()))};
  for (Index r = 0; r < record.trajectories(); ++r) write_trajectory(record, rates, r, signals);
  return signals;
}

}  // namespace lacuna
