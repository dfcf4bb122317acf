// SPDX-License-Identifier: MIT
#include "limit_options.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assignments.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::cli {
namespace {

[[noreturn]] void fail(const std::string& text, const std::string& problem) {
  throw ConfigError("--limits " + text, problem, "write e.g. --limits q=-5:5 or --limits q=:5");
}

/// The number in a part of the text, or none where it is empty.
std::optional<double> end_in(const std::string& text, const std::string& part) {
  if (trim(part).empty()) return std::nullopt;
  const auto value = parse_number(trim(part));
  if (!value || std::isnan(*value)) fail(text, "'" + part + "' is not a number");
  return value;
}

std::size_t state_in(const Dataset& data, const std::string& text, const std::string& name) {
  const auto found = std::find_if(data.states.begin(), data.states.end(),
                                  [&](const Quantity& state) { return state.name == name; });
  if (found == data.states.end()) fail(text, "there is no state '" + name + "'");
  return static_cast<std::size_t>(found - data.states.begin());
}

void read_limits(const Dataset& data, const Assignment& part, std::vector<Limits>& limits) {
  const auto& [text, name, ends] = part;
  const std::size_t colon = ends.find(':');
  if (colon == std::string::npos) fail(text, "this is not NAME=LOW:HIGH");
  const Limits given{end_in(text, ends.substr(0, colon)), end_in(text, ends.substr(colon + 1))};
  if (given.low && given.high && !(*given.low < *given.high))
    fail(text, "the lower end is not below the upper one");
  limits[state_in(data, text, name)] = given;
}

}  // namespace

Dataset with_given_limits(Dataset data, const std::vector<std::string>& texts) {
  std::vector<Limits> limits(data.states.size());
  for (const Assignment& part : read_assignments(
           {"--limits", "NAME=LOW:HIGH", "--limits q=-5:5 or --limits q=:5"}, texts))
    read_limits(data, part, limits);
  return texts.empty() ? data : with_limits(std::move(data), limits);
}

}  // namespace lacuna::cli
