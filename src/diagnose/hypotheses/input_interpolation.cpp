// SPDX-License-Identifier: MIT
// An input that was recorded seldom.
#include <algorithm>
#include <utility>

#include "core/base/text.hpp"
#include "corrected_inputs.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "records/channels/interpolated.hpp"

namespace lacuna {
namespace {

/// Samples of an input of a record that were not put on lines; empty where none were.
std::vector<Index> knots_of(const Trajectory& record, Index input) {
  const std::vector<Index> between = interpolated_samples(record, input);
  std::vector<Index> knots;
  if (between.empty()) return knots;
  for (Index i = 0; i < record.time.size(); ++i)
    if (!std::binary_search(between.begin(), between.end(), i)) knots.push_back(i);
  return knots;
}

std::vector<Index> interpolated_inputs(const Dataset& data) {
  std::vector<Index> inputs;
  for (Index j = 0; j < data.input_count(); ++j)
    if (is_interpolated(data, j)) inputs.push_back(j);
  return inputs;
}

/// Inputs that are on lines on the cubics through their knots.
Dataset smoothed(Dataset data) {
  for (Trajectory& record : data.trajectories)
    for (Index j = 0; j < data.input_count(); ++j) {
      const std::vector<Index> knots = knots_of(record, j);
      if (knots.empty()) continue;
      SampledSignal signal(record.time(knots), record.inputs(knots, j));
      for (Index i = 0; i < record.time.size(); ++i)
        record.inputs(i, j) = signal(record.time[i]);
    }
  return data;
}

std::string note_on(const Problem& problem, const std::vector<Index>& inputs) {
  std::vector<std::string> names;
  for (const Index j : inputs)
    names.push_back(problem.nominal.inputs()[static_cast<std::size_t>(j)].name);
  return join(names, ", ") +
         ": most samples lie on straight lines between others; a smooth curve through those "
         "explains the records better";
}

}  // namespace

Proposals InputInterpolation::do_propose(const Problem& problem,
                                         const CompositeModel& best) const {
  const std::vector<Index> inputs = interpolated_inputs(best.base->records->data);
  if (inputs.empty()) return {};
  problem.context.report("inputs that were recorded seldom", 0.0);
  return proposed_correction(problem, best, info().name, smoothed, note_on(problem, inputs));
}

}  // namespace lacuna
