// SPDX-License-Identifier: MIT
// How the lines of a logger are laid out where they are no plain table of numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell.hpp"

namespace lacuna {

/// One column of a log.
struct LogColumn {
  enum class Use {
    Number,    ///< taken over
    Quantity,  ///< its number, in the unit of the first one
    Time,      ///< a clock, with the date in front of it and the zone behind it
    Text,      ///< left out: no role can name it
    Blank,     ///< left out: nothing stands in it
    Label,     ///< left out: the name of the next one
    Count,     ///< left out: it counts the lines in front of a clock
    Clock,     ///< kept: times of the channels behind it, as the first one has others
  };
  Use use = Use::Number;
  std::string name = {};  ///< as in the header, or the label of its cells; may be empty
  std::string unit = {};   ///< of its cells
  std::string label = {};  ///< in its cells

  bool is_kept() const {
    return use == Use::Number || use == Use::Quantity || use == Use::Clock;
  }
};

/// The layout of a log.
struct LogLayout {
  char delimiter = ',';
  std::size_t before = 0;   ///< lines in front of the first sample
  std::vector<LogColumn> columns;
  std::size_t time = 0;        ///< first column of the clock
  std::size_t time_parts = 0;  ///< columns of it: date, time, zone; 0 where there is no clock
  DateOrder order = DateOrder::MonthFirst;
  bool order_is_certain = true;
};

/// Cells of a line; what an Arduino's monitor puts between its clock and the line (" -> ") is a
/// delimiter too.
std::vector<std::string> cells_of(std::string_view line, char delimiter);

/// The text of the clock in a line's cells.
std::string clock_in(const std::vector<std::string>& cells, const LogLayout& layout);

/// Finds the layout of a text in which some column is no plain number: a clock, text, a number
/// with its unit or label; or in which columns have the same names. The kind of a column is that
/// of nine in ten of its cells. Nothing where there is no such table, or a plain one.
/// @param begin whole lines, or all of the text.
std::optional<LogLayout> find_log_layout(std::string_view begin);

}  // namespace lacuna
