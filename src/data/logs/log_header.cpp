// SPDX-License-Identifier: MIT
#include "data/logs/log_header.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "data/formats/text_layout.hpp"
#include "data/records/text_field.hpp"
#include "data/times/time_names.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {
namespace {

using Names = std::vector<std::string>;

/// Names for the columns, the last one for the last column; nothing where there are too many or
/// too few, or where they are numbers.
std::optional<Names> aligned(const Names& line, const LogLayout& layout) {
  const std::size_t columns = layout.columns.size();
  // The clock of a monitor has no name; a date and a time may have one together.
  const std::size_t least = columns - std::min(layout.time_parts, columns - 1);
  if (line.size() > columns || line.size() < least) return std::nullopt;
  const bool any_text = std::any_of(line.begin(), line.end(), [](const std::string& name) {
    return read_field(name).kind == TextField::Kind::Text;
  });
  if (!any_text) return std::nullopt;
  Names names(columns - line.size());
  names.insert(names.end(), line.begin(), line.end());
  return names;
}

/// Whether names of a line do not distinguish the columns.
bool are_repeated(const Names& names) {
  std::set<std::string> seen;
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return !name.empty() && !seen.insert(name).second;
  });
}

/// The two lines in front of the samples that have as many names as there are columns.
struct NameLines {
  std::optional<Names> upper, lower;
};

NameLines name_lines(const std::vector<Names>& before, const LogLayout& layout) {
  NameLines lines;
  if (!before.empty()) lines.lower = aligned(before.back(), layout);
  if (lines.lower && before.size() > 1) lines.upper = aligned(before[before.size() - 2], layout);
  return lines;
}

/// "Sensor 1" above "temp" is "Sensor 1 temp".
Names combined(const Names& upper, const Names& lower) {
  Names names;
  for (std::size_t i = 0; i < upper.size(); ++i)
    names.push_back(upper[i] + (upper[i].empty() || lower[i].empty() ? "" : " ") + lower[i]);
  return names;
}

/// Whether every other cell of a line is the same: properties of channels that have their times
/// beside them ("Name", "x", "Name", "y").
bool is_property(const Names& line, std::size_t columns) {
  if (line.size() != columns || columns < 4 || columns % 2 != 0) return false;
  for (std::size_t i = 2; i < columns; i += 2)
    if (line[i] != line[0]) return false;
  return !line[0].empty();
}

/// Names from the properties of channels: each has a column of times in front of it, in the
/// unit of the property that is a time ("SampleTime[ms]"). Nothing where no property is a name.
std::optional<std::vector<Quantity>> property_names(const std::vector<Names>& before,
                                                    std::size_t columns) {
  std::vector<Quantity> found;
  std::string unit;
  for (const Names& line : before) {
    if (!is_property(line, columns)) continue;
    const Quantity label = split_header(line[0]);
    if (names_time(label.name)) unit = time_unit_symbol(label.unit).value_or(unit);
    if (lower_case(label.name) != "name") continue;
    for (std::size_t i = 0; i < columns; ++i)
      found.push_back(i % 2 == 0 ? Quantity{"Time", ""} : split_header(line[i]));
  }
  if (found.size() != columns) return std::nullopt;
  for (std::size_t i = 0; i < columns; i += 2) found[i].unit = unit;
  return found;
}

std::vector<Quantity> quantities_of(const Names& names) {
  std::vector<Quantity> quantities;
  for (const std::string& name : names) quantities.push_back(split_header(name));
  return quantities;
}

/// One header for each column; none where no line has the names.
std::vector<Quantity> headers_of(const std::vector<Names>& before, const LogLayout& layout) {
  if (auto found = property_names(before, layout.columns.size())) return *found;
  const NameLines lines = name_lines(before, layout);
  if (!lines.lower) return {};
  if (!lines.upper) return quantities_of(*lines.lower);
  std::vector<Quantity> with_units = quantities_of(*lines.upper);
  if (take_units({lines.lower->begin(), lines.lower->end()}, with_units)) return with_units;
  return quantities_of(are_repeated(*lines.lower) ? combined(*lines.upper, *lines.lower)
                                                  : *lines.lower);
}

}  // namespace

void name_log_columns(const std::vector<Names>& before, LogLayout& layout) {
  const std::vector<Quantity> headers = headers_of(before, layout);
  for (std::size_t i = 0; i < headers.size(); ++i) {
    LogColumn& column = layout.columns[i];
    if (!headers[i].name.empty()) column.name = headers[i].name;
    if (column.unit.empty()) column.unit = headers[i].unit;
  }
}

bool has_combined_names(const std::vector<Names>& before, const LogLayout& layout) {
  const NameLines lines = name_lines(before, layout);
  return lines.upper && are_repeated(*lines.lower) &&
         !are_repeated(combined(*lines.upper, *lines.lower));
}

}  // namespace lacuna
