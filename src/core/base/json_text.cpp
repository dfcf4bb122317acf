// SPDX-License-Identifier: MIT
#include "json_text.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

bool is_part_of_number(char c) {
  return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
}

/// Behind the string that begins at `at`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return at + 1;
}

}  // namespace

std::string line_and_column(std::string_view text, std::size_t byte) {
  const std::string_view before =
      text.substr(0, std::min(text.size(), byte > 0 ? byte - 1 : 0));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_end = before.rfind('\n');
  const std::size_t column =
      before.size() - (line_end == std::string_view::npos ? 0 : line_end + 1) + 1;
  return std::to_string(line) + ":" + std::to_string(column);
}

std::optional<std::size_t> deeper_than(std::size_t levels, std::string_view text) {
  std::size_t level = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') i = end_of_string(text, i) - 1;
    if ((c == ']' || c == '}') && level > 0) --level;
    if ((c == '[' || c == '{') && ++level > levels) return i + 1;
  }
  return std::nullopt;
}

std::optional<std::size_t> overflowing_number(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '"') {
      i = end_of_string(text, i);
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && is_part_of_number(text[end])) ++end;
    const auto value = parse_number(text.substr(i, end - i));
    if (value && std::isinf(*value)) return i + 1;
    i = std::max(end, i + 1);
  }
  return std::nullopt;
}

}  // namespace lacuna
