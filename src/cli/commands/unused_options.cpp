// SPDX-License-Identifier: MIT
#include "unused_options.hpp"

#include <algorithm>

#include "lacuna/core/base/error.hpp"

namespace lacuna::cli {

std::string why_not(const std::string& stage, const std::vector<StageDone>& stages) {
  const auto found = std::find_if(stages.begin(), stages.end(),
                                  [&](const StageDone& one) { return one.name == stage; });
  if (found == stages.end()) return "the stage `" + stage + "` was not reached";
  return found->done ? "" : "the stage `" + stage + "` was left out, " + found->why;
}

std::vector<AskedOption> without_effect(
    const std::vector<std::string>& assignments, const std::string& answer,
    const std::function<std::string(const std::vector<std::string>&)>& answer_to) {
  std::vector<AskedOption> same;
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    std::vector<std::string> fewer = assignments;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    try {
      if (answer_to(fewer) == answer)
        same.push_back({"--set " + assignments[i], "without it the answer is the same"});
    } catch (const Error&) {
      continue;  // without it there is no answer
    }
  }
  return same;
}

std::string unused_text(const std::vector<AskedOption>& asked) {
  std::string text;
  for (const AskedOption& one : asked)
    if (!one.unused.empty()) text += "  " + one.option + ": " + one.unused + "\n";
  return text.empty() ? "" : "\nOptions that decided nothing\n" + text;
}

}  // namespace lacuna::cli
