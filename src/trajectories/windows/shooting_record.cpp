// SPDX-License-Identifier: MIT
#include "shooting_record.hpp"

#include <algorithm>
#include <string>

#include "lacuna/core/base/error.hpp"
#include "lacuna/records/binding/gaps.hpp"

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

/// Samples of a delayed variable.
/// @throws DataError when it was not measured.
Vector samples_of(const DelayedVariable& delay, const ShootingRecord& record, Index dimension) {
  const Index input = delay.slot - dimension;
  if (input < 0) {
    if (const auto row = record.rows[static_cast<std::size_t>(delay.slot)])
      return record.values.col(*row);
  } else if (input < record.inputs.cols()) {
    return record.inputs.col(input);
  }
  throw DataError("record", "a delayed variable of the model was not measured",
                  "delay measured states and inputs only");
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
  for (std::size_t i = 0; i < inputs.size(); ++i)
    record.holds.push_back(interpolation_of(model.symbolic().inputs()[i].hold));
  for (const Trajectory& run : data.trajectories) {
    const Index first = record.begins.back(), n = run.samples();
    record.time.segment(first, n) = run.time;
    record.values.middleRows(first, n) = run.states(Eigen::all, columns);
    if (!inputs.empty()) record.inputs.middleRows(first, n) = run.inputs(Eigen::all, inputs);
    record.begins.push_back(first + n);
  }
  return record;
}

std::vector<DrivingSamples> driving_samples(const ShootingRecord& record, const Rates& rates) {
  DrivingSamples all{record.time, record.inputs, {}, {}, record.holds};
  all.delayed.resize(record.samples(), static_cast<Index>(rates.delays().size()));
  for (const DelayedVariable& delay : rates.delays()) {
    all.delayed.col(static_cast<Index>(all.delays.size())) =
        samples_of(delay, record, rates.dimension());
    all.delays.push_back(delay.delay);
    all.affine = delay.affine;
    const Index input = delay.slot - rates.dimension();
    all.signals.push_back(input < 0 ? Interpolation::Cubic
                                    : record.holds[static_cast<std::size_t>(input)]);
  }
  std::vector<DrivingSamples> driving;
  for (std::size_t r = 0; r + 1 < record.begins.size(); ++r) {
    const Index first = record.begins[r], n = record.begins[r + 1] - first;
    driving.push_back({all.time.segment(first, n), all.inputs.middleRows(first, n),
                       all.delayed.middleRows(first, n), all.delays, all.signals,
                       all.affine});
  }
  return driving;
}

StageSignals stage_signals(const ShootingRecord& record, const Rates& rates,
                           const StepScheme& scheme) {
  StageSignals signals = empty_stage_signals(scheme, record.samples(), rates.signals());
  const std::vector<DrivingSamples> driving = driving_samples(record, rates);
  for (std::size_t r = 0; r < driving.size(); ++r)
    write_stage_signals(driving[r], record.begins[r], signals);
  return signals;
}

}  // namespace lacuna
