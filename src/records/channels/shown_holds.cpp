// SPDX-License-Identifier: MIT
#include "records/channels/shown_holds.hpp"

#include <vector>

#include "data/records/check_record.hpp"

namespace lacuna {

std::optional<Hold> shown_hold(const Dataset& data, Index input) {
  check_input(data, input, "shown_hold");
  bool moves = false, held = true;
  for (const Trajectory& record : data.trajectories) {
    const auto values = record.inputs.col(input);
    if (values.size() == 0) continue;
    if (values.minCoeff() == values.maxCoeff()) continue;
    moves = true;
    held = held && shows_hold(values);
  }
  if (!moves) return std::nullopt;
  return held ? Hold::Zero : Hold::Smooth;
}

std::optional<Dataset> with_shown_holds(const Dataset& data) {
  std::vector<std::size_t> held;
  for (std::size_t j = 0; j < data.inputs.size(); ++j)
    if (!data.inputs[j].hold && shown_hold(data, static_cast<Index>(j)) == Hold::Zero)
      held.push_back(j);
  if (held.empty()) return std::nullopt;
  Dataset result = data;
  for (const std::size_t j : held) result.inputs[j].hold = Hold::Zero;
  return result;
}

std::vector<Index> held_inputs(const Dataset& data) {
  std::vector<Index> held;
  for (std::size_t j = 0; j < data.inputs.size(); ++j)
    if (data.inputs[j].hold == Hold::Zero) held.push_back(static_cast<Index>(j));
  return held;
}

OdeModel with_shown_holds(const OdeModel& model, const Dataset& data) {
  std::vector<std::optional<Hold>> holds;
  for (const Quantity& input : model.inputs()) {
    const auto j = static_cast<Index>(holds.size());
    holds.push_back(input.hold ? input.hold : shown_hold(data, j));
  }
  return model.with_holds(holds);
}

}  // namespace lacuna
