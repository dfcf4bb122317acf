// SPDX-License-Identifier: MIT
#include "unused_options.hpp"

#include <algorithm>

namespace lacuna::cli {

std::string why_not(const std::string& stage, const std::vector<StageDone>& stages) {
  const auto found = std::find_if(stages.begin(), stages.end(),
                                  [&](const StageDone& one) { return one.name == stage; });
  if (found == stages.end()) return "the stage `" + stage + "` was not reached";
  return found->done ? "" : "the stage `" + stage + "` was left out, " + found->why;
}

std::string unused_text(const std::vector<AskedOption>& asked) {
  std::string text;
  for (const AskedOption& one : asked)
    if (!one.unused.empty()) text += "  " + one.option + ": " + one.unused + "\n";
  return text.empty() ? "" : "\nOptions that decided nothing\n" + text;
}

}  // namespace lacuna::cli
