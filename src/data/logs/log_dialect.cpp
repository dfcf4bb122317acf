// SPDX-License-Identifier: MIT
// Files of loggers as plain tables: clocks as seconds, numbers without their units and labels,
// columns of text left out.
#include <algorithm>
#include <utility>

#include "core/base/text.hpp"
#include "data/formats/dialects.hpp"
#include "data/logs/log_layout.hpp"
#include "data/records/text_field.hpp"
#include "data/times/time_names.hpp"
#include "data/units/units.hpp"

namespace lacuna::dialects {
namespace {

using Use = LogColumn::Use;
using LogCells = std::vector<std::string>;

/// Takes the lines of a log: some of a preamble, then samples.
class LogTranslator {
 public:
  explicit LogTranslator(LogLayout layout) : layout_(std::move(layout)) {}

  void operator()(std::string_view line, std::string& text) {
    ++line_;
    const std::string_view content = strip(line);
    if (line_ <= layout_.before || content.empty() || content.front() == '#') {
      text += '\n';
      return;
    }
    LogCells cells = cells_of(line, layout_.delimiter);
    if (cells.size() == layout_.columns.size() + 1 && cells.back().empty()) cells.pop_back();
    text += cells.size() == layout_.columns.size() ? row_of(cells) : ragged_line(cells);
  }

 private:
  /// One field, which no table has in a line: the reader says what is wrong with it.
  static std::string ragged_line(const LogCells& cells) {
    const auto filled = std::find_if(cells.begin(), cells.end(),
                                     [](const std::string& cell) { return !cell.empty(); });
    return (filled == cells.end() ? "?" : *filled) + "\n";
  }

  std::string row_of(const LogCells& cells) {
    LogCells row;
    if (layout_.time_parts > 0) row.push_back(time_of(cells));
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (layout_.columns[i].is_kept()) row.push_back(value_of_cell(cells[i], layout_.columns[i]));
    return join(row, ";") + "\n";
  }

  /// The number, in the unit of the column; as it is written where it is none.
  static std::string value_of_cell(const std::string& text, const LogColumn& column) {
    if (column.use != Use::Quantity) return text;
    const Cell cell = read_cell(text);
    if (cell.kind != Cell::Kind::Quantity) return text;
    if (cell.label != column.label) return text;
    if (cell.unit == column.unit || cell.unit.empty()) return std::string(cell.number);
    const auto change = conversion(cell.unit, column.unit);
    if (!change) return text;
    return format_number(change->factor * read_field(cell.number).value + change->offset);
  }

  std::string time_of(const LogCells& cells) {
    const std::string written = clock_in(cells, layout_);
    const auto clock = read_clock(written, layout_.order);
    if (!clock) return written;
    check(*clock, written);
    return stamp_text(elapsed_(*clock));
  }

  /// @throws LineProblem
  void check(const ClockTime& clock, const std::string& written) {
    const auto fail = [&](const std::string& problem, const std::string& remedy) {
      throw LineProblem{line_, layout_.time + 1, "the time '" + written + "': " + problem,
                        remedy};
    };
    if (!clock.problem.empty()) fail(clock.problem, "write a time that there is");
    if (!usual_) usual_ = clock;
    if (clock.has_day != usual_->has_day)
      fail("it has " + std::string(clock.has_day ? "a" : "no") + " date, others have " +
               (clock.has_day ? "none" : "one"),
           "write all times with their date");
    if (clock.zone.has_value() != usual_->zone.has_value())
      fail("it has " + std::string(clock.zone ? "a" : "no") + " zone, others have " +
               (clock.zone ? "none" : "one"),
           "write all times with their zone, or none of them");
  }

  LogLayout layout_;
  std::size_t line_ = 0;            ///< of the file, from 1
  std::optional<ClockTime> usual_;  ///< the first one: all are written as it is
  ElapsedTimes elapsed_;
};

/// A name as a header of the table has it, with its unit.
std::string header_name(const LogColumn& column) {
  std::string name = column.name;
  std::replace(name.begin(), name.end(), ';', ',');
  if (read_field(name).kind == TextField::Kind::Number) name = "c_" + name;
  return column.unit.empty() ? name : name + " [" + column.unit + "]";
}

/// The line of names; empty where there are none.
std::string header_of(const LogLayout& layout) {
  LogCells names;
  bool any = layout.time_parts > 0;
  if (any) names.push_back("t [s]");
  for (const LogColumn& column : layout.columns) {
    if (!column.is_kept()) continue;
    names.push_back(header_name(column));
    any = any || !names.back().empty();
  }
  return any ? join(names, ";") + "\n" : "";
}

/// A column for people: its name, or its number.
std::string shown(const LogLayout& layout, std::size_t column) {
  const std::string& name = layout.columns[column].name;
  return name.empty() ? std::to_string(column + 1) : "'" + name + "'";
}

/// "columns 'mode', 'state' are text and are left out"; empty where there are none.
std::string left_out(const LogLayout& layout, Use use, const std::string& what) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < layout.columns.size(); ++i)
    if (layout.columns[i].use == use) names.push_back(shown(layout, i));
  if (names.empty()) return "";
  const bool many = names.size() > 1;
  return (many ? "columns " : "column ") + join(names, ", ") + (many ? " are " : " is ") + what +
         " and left out";
}

/// Where the columns of the table stand in the file, from 0.
std::vector<std::size_t> places_of(const LogLayout& layout) {
  std::vector<std::size_t> places;
  if (layout.time_parts > 0) places.push_back(layout.time);
  for (std::size_t i = 0; i < layout.columns.size(); ++i)
    if (layout.columns[i].is_kept()) places.push_back(i);
  return places;
}

/// What the clock of the first sample shows, in seconds.
std::optional<double> clock_start_of(std::string_view begin, const LogLayout& layout) {
  if (layout.time_parts == 0) return std::nullopt;
  Lines lines(begin);
  for (std::size_t number = 0; const auto line = lines.next(); ++number) {
    const LogCells cells = cells_of(*line, layout.delimiter);
    if (number < layout.before || cells.size() < layout.columns.size()) continue;
    if (const auto clock = read_clock(clock_in(cells, layout), layout.order))
      return value_of(clock->seconds());
  }
  return std::nullopt;
}

/// Columns of the table that are times of channels; none where all have the first one's.
std::vector<Index> clocks_of(const LogLayout& layout) {
  std::vector<Index> clocks;
  std::optional<Index> first;
  const std::vector<std::size_t> places = places_of(layout);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const LogColumn& column = layout.columns[places[i]];
    if (!first && names_time(column.name)) first = static_cast<Index>(i);
    if (column.use == Use::Clock) clocks.push_back(static_cast<Index>(i));
  }
  if (!clocks.empty()) clocks.insert(clocks.begin(), first.value());
  return clocks;
}

std::string note_of(const LogLayout& layout) {
  std::vector<std::string> parts;
  if (layout.time_parts > 0)
    parts.emplace_back("times of a clock are seconds since the first one");
  if (!layout.order_is_certain)
    parts.push_back(std::string("nothing shows the order of day and month: dates are read as ") +
                    (layout.order == DateOrder::MonthFirst ? "month/day/year"
                                                           : "day/month/year"));
  for (const auto& [use, what] :
       {std::pair{Use::Text, "text"}, std::pair{Use::Blank, "blank"},
        std::pair{Use::Count, "the number of the line"}})
    if (std::string part = left_out(layout, use, what); !part.empty())
      parts.push_back(std::move(part));
  const bool any_quantity =
      std::any_of(layout.columns.begin(), layout.columns.end(),
                  [](const LogColumn& column) { return column.use == Use::Quantity; });
  if (any_quantity) parts.emplace_back("numbers are read without the units and names beside them");
  if (parts.empty() && clocks_of(layout).empty())
    parts.emplace_back("names are read from two lines");
  return join(parts, "; ");
}

}  // namespace

std::optional<TextDialect> log_of_device(std::string_view begin) {
  auto layout = find_log_layout(begin);
  if (!layout) return std::nullopt;
  TextDialect dialect{note_of(*layout), LogTranslator(*layout), "", header_of(*layout),
                      layout->delimiter};
  dialect.places = places_of(*layout);
  dialect.makes_first = layout->time_parts > 0;
  dialect.clocks = clocks_of(*layout);
  dialect.clock_start = clock_start_of(begin, *layout);
  return dialect;
}

}  // namespace lacuna::dialects
