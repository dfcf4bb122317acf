// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "lacuna/core/base/stages_done.hpp"

namespace lacuna {

/// [{"stage": "equations", "done": true, "why": ""}, ...], in the order of the run.
inline nlohmann::ordered_json stages_json(const std::vector<StageDone>& stages) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const StageDone& stage : stages)
    list.push_back({{"stage", stage.name}, {"done", stage.done}, {"why", stage.why}});
  return list;
}

}  // namespace lacuna
