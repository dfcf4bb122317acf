// SPDX-License-Identifier: MIT
// What one cell of a log holds beside numbers.
#pragma once

#include <string>
#include <string_view>

#include "data/times/clock_times.hpp"

namespace lacuna {

/// One cell: "1.2", "12.3 V", "x:1.2", "\"x\": 1.2", "10:00:00", "base_link".
struct Cell {
  enum class Kind { Missing, Number, Quantity, Clock, Text };
  Kind kind = Kind::Missing;
  std::string_view number;  ///< of a Number or a Quantity
  std::string label = {};   ///< in front of a Quantity
  std::string unit = {};    ///< behind it, a known one
};

/// Reads a cell. What is a number behind a label (a name and `:` or `=`), or in front of a known
/// unit, is a Quantity.
Cell read_cell(std::string_view text, DateOrder order = DateOrder::MonthFirst);

}  // namespace lacuna
