// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Lines of a text from which rows came: stretches with the same number of lines from row to
/// row, which are few in most texts.
class LineNumbers {
 public:
  /// Where there are more stretches, the lines of later rows are not known (6 MiB).
  static constexpr std::size_t kMost = std::size_t{1} << 18U;

  /// Adds the lines of the next rows, which rise.
  void append(std::span<const std::size_t> lines);

  /// Lines of rows [first, first + count); empty where one of them is not known.
  std::vector<std::size_t> of(Index first, Index count) const;

 private:
  struct Stretch {
    std::size_t first_row = 0;
    std::size_t line = 0;  ///< of the first row
    std::size_t step = 1;

    std::size_t line_of(std::size_t row) const { return line + (row - first_row) * step; }
  };

  void add(std::size_t line);

  std::vector<Stretch> stretches_;
  std::size_t rows_ = 0;
};

}  // namespace lacuna
