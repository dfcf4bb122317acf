// SPDX-License-Identifier: MIT
#include "data/logs/log_layout.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/text.hpp"
#include "data/formats/dialects.hpp"
#include "data/logs/damage.hpp"
#include "data/logs/log_header.hpp"
#include "data/records/text_field.hpp"
#include "data/times/date_order.hpp"
#include "data/times/time_names.hpp"

namespace lacuna {
namespace {

using Cells = std::vector<std::string>;
using Use = LogColumn::Use;

/// Lines at the begin that show the layout: preambles of instruments are shorter by far.
constexpr std::size_t kLookedLines = 1000;

/// Fraction of its cells that decides on the kind of a column. Stray bytes and words for a
/// failed sensor are in fewer; with 0.8 or 0.95 the same files are read.
constexpr double kUsual = 0.9;

/// A line with its cells under one delimiter.
struct LogLine {
  std::size_t number = 0;  ///< from 0
  Cells cells;
};

bool begins_with_value(const Cells& cells) {
  const Cell::Kind kind = read_cell(cells.front()).kind;
  return kind != Cell::Kind::Text && kind != Cell::Kind::Missing;
}

std::vector<LogLine> lines_of(std::string_view begin, char delimiter) {
  std::vector<LogLine> found;
  Lines lines(begin);
  for (std::size_t number = 0; found.size() < kLookedLines; ++number) {
    const auto line = lines.next();
    if (!line) break;
    const std::string_view content = strip(*line);
    if (is_summary(content) && !found.empty() && begins_with_value(found.back().cells)) break;
    if (content.empty() || content.front() == '#') continue;
    found.push_back({number, cells_of(*line, delimiter)});
  }
  return found;
}

/// The number of cells that most lines have, of two the larger one.
std::size_t usual_count(const std::vector<LogLine>& lines) {
  std::map<std::size_t, std::size_t> counts;
  for (const LogLine& line : lines) ++counts[line.cells.size()];
  std::size_t best = 0;
  for (const auto& [cells, times] : counts)
    if (best == 0 || times >= counts[best]) best = cells;
  return best;
}

/// What the cells of a column are.
struct CellCounts {
  std::map<Cell::Kind, std::size_t> kinds;
  std::map<std::string, std::size_t> labels, units;
  std::size_t filled = 0;
  bool is_constant = true;

  bool mostly(std::size_t count) const {
    return static_cast<double>(count) >= kUsual * static_cast<double>(filled);
  }
  std::size_t count(Cell::Kind kind) const {
    const auto found = kinds.find(kind);
    return found == kinds.end() ? 0 : found->second;
  }
};

const std::string& most_frequent(const std::map<std::string, std::size_t>& counts) {
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

CellCounts count_cells(const std::vector<LogLine>& lines, std::size_t column) {
  CellCounts counts;
  for (const LogLine& line : lines) {
    const std::string& text = line.cells[column];
    const Cell cell = read_cell(text);
    if (cell.kind == Cell::Kind::Missing) continue;
    ++counts.filled;
    ++counts.kinds[cell.kind];
    counts.is_constant = counts.is_constant && text == lines.front().cells[column];
    if (cell.kind != Cell::Kind::Quantity) continue;
    ++counts.labels[cell.label];
    ++counts.units[cell.unit];
  }
  return counts;
}

/// The kind of a column; a clock is a Time until the columns are seen together.
LogColumn column_of(const CellCounts& counts, const std::string& first) {
  if (counts.filled == 0) return {Use::Blank};
  const std::size_t quantities = counts.count(Cell::Kind::Quantity);
  if (counts.mostly(counts.count(Cell::Kind::Clock))) return {Use::Time};
  if (counts.mostly(counts.count(Cell::Kind::Number))) return {Use::Number};
  if (counts.mostly(quantities + counts.count(Cell::Kind::Number)) &&
      counts.mostly(counts.labels.at(most_frequent(counts.labels))))
    return {Use::Quantity, most_frequent(counts.labels), most_frequent(counts.units),
            most_frequent(counts.labels)};
  const bool names_next = first.ends_with(':') || first.ends_with('=');
  if (counts.is_constant && names_next) return {Use::Label};
  // Words among numbers are no text: the reader says where they are.
  return {2 * counts.count(Cell::Kind::Text) > counts.filled ? Use::Text : Use::Number};
}

/// The columns by the lines at the end, which are samples.
std::vector<LogColumn> columns_of(const std::vector<LogLine>& lines) {
  const std::vector<LogLine> last(lines.begin() + static_cast<std::ptrdiff_t>(lines.size() / 2),
                                  lines.end());
  std::vector<LogColumn> columns;
  for (std::size_t i = 0; i < lines.front().cells.size(); ++i)
    columns.push_back(column_of(count_cells(last, i), last.front().cells[i]));
  for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
    if (columns[i].use != Use::Label) continue;
    const std::string& label = last.front().cells[i];
    columns[i + 1].name = std::string(strip(label.substr(0, label.size() - 1)));
  }
  return columns;
}

bool fits(const std::string& text, Use use) {
  const Cell::Kind kind = read_cell(text).kind;
  if (kind == Cell::Kind::Missing) return true;
  switch (use) {
    case Use::Number:
      return kind == Cell::Kind::Number;
    case Use::Quantity:
      return kind == Cell::Kind::Number || kind == Cell::Kind::Quantity;
    case Use::Time:
      return kind == Cell::Kind::Clock;
    default:
      return true;
  }
}

/// A sample has a value in some column and nothing else where values belong.
bool is_sample(const LogLine& line, const std::vector<LogColumn>& columns) {
  bool any = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!fits(line.cells[i], columns[i].use)) return false;
    const bool has_values = columns[i].is_kept() || columns[i].use == Use::Time;
    any = any || (has_values && read_cell(line.cells[i]).kind != Cell::Kind::Missing);
  }
  return any;
}

/// A table that one delimiter makes of the lines.
struct Candidate {
  char delimiter = ',';
  std::vector<LogLine> lines;    ///< all of them
  std::vector<LogLine> samples;  ///< from the first one on, those with the usual count
  std::vector<LogColumn> columns;
  int values = 0, texts = 0;  ///< columns of each kind
};

bool is_better(const Candidate& a, const Candidate& b) {
  return a.values - a.texts > b.values - b.texts;
}

/// Whether commas are those of decimals: most lines are numbers between other delimiters.
bool are_decimal_commas(std::string_view begin) {
  const auto is_numbers = [](const LogLine& line) {
    return line.cells.size() > 1 &&
           std::all_of(line.cells.begin(), line.cells.end(), [](const std::string& cell) {
             return read_field(cell).kind == TextField::Kind::Number;
           });
  };
  for (const char delimiter : {';', '\t', ' '}) {
    const std::vector<LogLine> lines = lines_of(begin, delimiter);
    const auto numbers = std::count_if(lines.begin(), lines.end(), is_numbers);
    if (2 * static_cast<std::size_t>(numbers) > lines.size()) return true;
  }
  return false;
}

std::optional<Candidate> candidate(std::string_view begin, char delimiter) {
  if (delimiter == ',' && are_decimal_commas(begin)) return std::nullopt;
  Candidate found{delimiter, lines_of(begin, delimiter), {}, {}};
  if (found.lines.empty()) return std::nullopt;
  const std::size_t count = usual_count(found.lines);
  std::vector<LogLine> alike = found.lines;
  std::erase_if(alike, [&](const LogLine& line) { return line.cells.size() != count; });
  found.columns = columns_of(alike);
  const auto first = std::find_if(alike.begin(), alike.end(), [&](const LogLine& line) {
    return is_sample(line, found.columns);
  });
  found.samples.assign(first, alike.end());
  const auto good = std::count_if(
      found.samples.begin(), found.samples.end(),
      [&](const LogLine& line) { return is_sample(line, found.columns); });
  // What the lines at the end lack may be there before: channels have lengths of their own.
  for (std::size_t i = 0; i < count; ++i)
    if (found.columns[i].use == Use::Blank && !found.samples.empty())
      found.columns[i] = column_of(count_cells(found.samples, i), "");
  if (found.samples.empty() ||
      static_cast<double>(good) < kUsual * static_cast<double>(found.samples.size()))
    return std::nullopt;
  for (const LogColumn& column : found.columns) {
    if (column.is_kept() || column.use == Use::Time) ++found.values;
    if (column.use == Use::Text) ++found.texts;
  }
  return found;
}

/// How many columns from one on are a clock: a date and a time in two, a zone behind them
/// ("+0200", "UTC"; not "+02", which may be a number) in a third.
std::size_t parts_of_clock(const Candidate& found, std::size_t column) {
  const auto all_are = [&](std::size_t parts, const auto& holds) {
    return column + parts <= found.columns.size() &&
           std::all_of(found.samples.begin(), found.samples.end(), [&](const LogLine& line) {
             std::string text = line.cells[column];
             for (std::size_t i = 1; i < parts; ++i) text += " " + line.cells[column + i];
             const auto clock = read_clock(text);
             return clock && holds(*clock, line.cells[column + parts - 1]);
           });
  };
  const auto is_date = [](const ClockTime& clock, const std::string&) {
    return !clock.has_time;
  };
  const auto is_moment = [](const ClockTime& clock, const std::string&) {
    return clock.has_time;
  };
  const auto is_zoned = [](const ClockTime& clock, const std::string& zone) {
    constexpr std::size_t kShortest = 3, kWithMinutes = 5;
    const bool may_be_zone =
        zone.size() >= kWithMinutes || (zone.size() >= kShortest && zone[0] > '9');
    return may_be_zone && clock.zone && clock.problem.empty();
  };
  if (!all_are(1, is_date) || !all_are(2, is_moment)) return 1;
  return all_are(3, is_zoned) ? 3 : 2;
}

/// Whether some column of numbers is the time already.
bool has_time_of_its_own(const std::vector<LogColumn>& columns) {
  return std::any_of(columns.begin(), columns.end(), [](const LogColumn& column) {
    const std::string name = lower_case(column.name);
    return column.is_kept() && (name == "t" || name == "time");
  });
}

/// The first clock is the time; further ones are text.
void take_clock(const Candidate& found, LogLayout& layout) {
  const auto is_clock = [](const LogColumn& column) { return column.use == Use::Time; };
  const auto first = std::find_if(layout.columns.begin(), layout.columns.end(), is_clock);
  if (first != layout.columns.end() && !has_time_of_its_own(layout.columns)) {
    layout.time = static_cast<std::size_t>(first - layout.columns.begin());
    layout.time_parts = parts_of_clock(found, layout.time);
  }
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const bool is_part = i >= layout.time && i < layout.time + layout.time_parts;
    if (is_part) layout.columns[i].use = Use::Time;
    if (!is_part && is_clock(layout.columns[i])) layout.columns[i].use = Use::Text;
  }
}

/// The order of dates, by all lines of the begin.
void find_date_order(std::string_view begin, LogLayout& layout) {
  if (layout.time_parts == 0) return;
  std::vector<std::string> texts;
  Lines lines(begin);
  while (const auto line = lines.next()) {
    const Cells cells = cells_of(*line, layout.delimiter);
    if (cells.size() == layout.columns.size()) texts.push_back(clock_in(cells, layout));
  }
  const DatesRead read = order_of_dates(texts);
  layout.order = read.order;
  layout.order_is_certain = read.is_certain;
}

/// Whether a column without a name in letters is a whole number that is 1 more in each line.
bool counts_lines(const Candidate& found, std::size_t column) {
  const std::string& name = found.columns[column].name;
  if (std::any_of(name.begin(), name.end(), [](char c) { return std::isalnum(c & 0x7F); }))
    return false;
  std::optional<double> last;
  for (const LogLine& line : found.samples) {
    const auto value = parse_number(line.cells[column]);
    if (!value || *value != std::round(*value)) return false;
    if (last && *value != *last + 1.0) return false;
    last = value;
  }
  return found.samples.size() > 1;
}

/// Columns of times with the name of an earlier one belong to the channels behind them.
void find_further_clocks(std::vector<LogColumn>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto first = std::find_if(columns.begin(), columns.end(), [&](const LogColumn& other) {
      return other.is_kept() && other.name == columns[i].name;
    });
    const auto number = static_cast<std::size_t>(first - columns.begin());
    if (number < i && columns[i].is_kept() && names_time(columns[i].name)) {
      columns[i].use = Use::Clock;
      columns[i].name += "_" + std::to_string(i + 1);
    }
  }
}

bool is_plain_column(const LogColumn& column) { return column.use == Use::Number; }

}  // namespace

std::vector<std::string> cells_of(std::string_view line, char delimiter) {
  constexpr std::string_view kArrow = " -> ";
  std::vector<std::string_view> fields;
  std::string plain(line);
  if (const std::size_t at = plain.find(kArrow);
      at != std::string::npos && read_clock(plain.substr(0, at)))
    plain.replace(at, kArrow.size(), 1, delimiter);
  split_fields(plain, delimiter, fields);
  return {fields.begin(), fields.end()};
}

std::string clock_in(const std::vector<std::string>& cells, const LogLayout& layout) {
  std::string text = cells[layout.time];
  for (std::size_t i = 1; i < layout.time_parts; ++i) text += " " + cells[layout.time + i];
  return text;
}

std::optional<LogLayout> find_log_layout(std::string_view begin) {
  std::optional<Candidate> best;
  for (const char delimiter : {',', ';', '\t', ' '}) {
    auto found = candidate(begin, delimiter);
    if (found && (!best || is_better(*found, *best))) best = std::move(found);
  }
  // A time and a value, or a value alone: else these are sentences with numbers.
  if (!best || best->values == 0 || (best->values == 1 && best->texts > 0)) return std::nullopt;
  LogLayout layout{best->delimiter, best->samples.front().number, best->columns};
  take_clock(*best, layout);
  std::vector<Cells> before;
  for (const LogLine& line : best->lines)
    if (line.number < layout.before) before.push_back(line.cells);
  name_log_columns(before, layout);
  best->columns = layout.columns;
  find_further_clocks(layout.columns);
  for (std::size_t i = 0; i < layout.time && layout.time_parts > 0; ++i)
    if (layout.columns[i].use == Use::Number && counts_lines(*best, i))
      layout.columns[i].use = Use::Count;
  if (std::all_of(layout.columns.begin(), layout.columns.end(), is_plain_column) &&
      !has_combined_names(before, layout))
    return std::nullopt;
  find_date_order(begin, layout);
  return layout;
}

}  // namespace lacuna
