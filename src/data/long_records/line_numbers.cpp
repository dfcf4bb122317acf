// SPDX-License-Identifier: MIT
#include "line_numbers.hpp"

#include <algorithm>

namespace lacuna {

void LineNumbers::append(std::span<const std::size_t> lines) {
  for (const std::size_t line : lines) {
    if (stretches_.size() == kMost) return;
    add(line);
  }
}

void LineNumbers::add(std::size_t line) {
  const std::size_t row = rows_++;
  if (stretches_.empty()) return stretches_.push_back({row, line});
  Stretch& last = stretches_.back();
  if (row == last.first_row + 1) last.step = line - last.line;
  if (line != last.line_of(row)) stretches_.push_back({row, line});
}

std::vector<std::size_t> LineNumbers::of(Index first, Index count) const {
  const auto begin = static_cast<std::size_t>(first);
  const auto end = begin + static_cast<std::size_t>(count);
  std::vector<std::size_t> lines;
  if (end > rows_ || count == 0) return lines;
  auto stretch = std::upper_bound(
      stretches_.begin(), stretches_.end(), begin,
      [](std::size_t row, const Stretch& other) { return row < other.first_row; });
  for (std::size_t row = begin; row < end; ++row) {
    while (stretch != stretches_.end() && stretch->first_row <= row) ++stretch;
    lines.push_back((stretch - 1)->line_of(row));
  }
  return lines;
}

}  // namespace lacuna
