// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna::support {

/// A data set of one record. Where there are no inputs, each sample has none of them.
inline Dataset one_record(std::vector<Quantity> states, std::vector<Quantity> inputs,
                          Trajectory record) {
  if (inputs.empty()) record.inputs.resize(record.samples(), 0);
  Dataset data;
  data.states = std::move(states);
  data.inputs = std::move(inputs);
  data.trajectories.push_back(std::move(record));
  return data;
}

}  // namespace lacuna::support
