// SPDX-License-Identifier: MIT
#include "lacuna/core/base/stages_done.hpp"

#include <algorithm>

#include "core/base/text.hpp"

namespace lacuna {

std::string answer_from(const std::vector<StageDone>& stages) {
  const auto last =
      std::find_if(stages.rbegin(), stages.rend(), [](const auto& stage) { return stage.done; });
  return last == stages.rend() ? "" : last->name;
}

std::string left_out_line(const std::vector<StageDone>& stages) {
  std::vector<std::string> reasons;
  for (const char* why : {kTimeIsUp, kIsQuick}) {
    std::vector<std::string> names;
    for (const StageDone& stage : stages)
      if (!stage.done && stage.why == why) names.push_back(stage.name);
    if (!names.empty()) reasons.push_back(join(names, ", ") + " (" + why + ")");
  }
  return reasons.empty() ? "" : "left out: " + join(reasons, "; ");
}

}  // namespace lacuna
