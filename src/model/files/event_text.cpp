// SPDX-License-Identifier: MIT
#include "event_text.hpp"

#include "core/base/text.hpp"

namespace lacuna {
namespace {

ResetParts parts_of(std::string_view text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string_view::npos) return {};
  ResetParts parts{.state = trim(text.substr(0, sign)), .formula = trim(text.substr(sign + 1))};
  constexpr std::string_view kSigns = "+-*";
  if (parts.state.empty() || kSigns.find(parts.state.back()) == std::string_view::npos)
    return parts;
  parts.operation = parts.state.back();
  parts.state = trim(parts.state.substr(0, parts.state.size() - 1));
  return parts;
}

}  // namespace

std::optional<ConditionSides> condition_sides(std::string_view condition) {
  const std::size_t sign = condition.find_first_of("<>");
  if (sign == std::string_view::npos) return std::nullopt;
  if (condition.find_first_of("<>", sign + 1) != std::string_view::npos) return std::nullopt;
  const bool or_equal = sign + 1 < condition.size() && condition[sign + 1] == '=';
  const std::string_view left = trim(condition.substr(0, sign)),
                         right = trim(condition.substr(sign + (or_equal ? 2 : 1)));
  if (condition[sign] == '>') return ConditionSides{left, right};
  return ConditionSides{right, left};
}

std::vector<ResetParts> reset_parts(std::string_view text) {
  std::vector<ResetParts> all;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '(') ++depth;
    if (i < text.size() && text[i] == ')') --depth;
    if (i < text.size() && (text[i] != ',' || depth != 0)) continue;
    all.push_back(parts_of(text.substr(begin, i - begin)));
    begin = i + 1;
  }
  return all;
}

Expression reset_value(const ResetParts& parts, const Expression& right) {
  const Expression state = Expression::variable(std::string(parts.state));
  switch (parts.operation) {
    case '+':
      return state + right;
    case '-':
      return state - right;
    case '*':
      return state * right;
    default:
      return right;
  }
}

}  // namespace lacuna
