// SPDX-License-Identifier: MIT
#include "lacuna/data/records/roles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "blanks.hpp"
#include "core/base/check.hpp"
#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "data/records/own_times.hpp"
#include "data/records/piece_name.hpp"
#include "data/records/repeated_times.hpp"
#include "data/records/split.hpp"
#include "data/records/text_field.hpp"
#include "data/times/time_names.hpp"

namespace lacuna {
namespace {

std::vector<std::string> names_of(const Table& table) {
  std::vector<std::string> names;
  for (const Quantity& column : table.columns) names.push_back(column.name);
  return names;
}

const std::string& name_of(const Table& table, Index column) {
  return table.columns[static_cast<std::size_t>(column)].name;
}

std::optional<Index> find_name(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return found - names.begin();
}

Index column_of(const Table& table, const std::string& name) {
  const std::vector<std::string> names = names_of(table);
  if (const auto column = find_name(names, name)) return *column;
  if (const auto column = find_name(table.headers, name)) return *column;
  const bool has_names = std::any_of(table.headers.begin(), table.headers.end(),
                                     [](const std::string& header) { return !header.empty(); });
  const std::string remedy =
      has_names ? suggestion(name, names) + "; or name one so (--map " + name + "=COLUMN)"
                : "its " + std::to_string(names.size()) + " columns have no names: name all in " +
                      "their order, or single ones by their number (--map " + name + "=1)";
  throw DataError(table.source, "there is no column '" + name + "'", remedy);
}

std::vector<Index> columns_of(const Table& table, const std::vector<std::string>& names) {
  std::vector<Index> columns;
  for (const std::string& name : names) columns.push_back(column_of(table, name));
  return columns;
}

/// The name of a column as the file has it.
const std::string& written_name(const Table& table, std::size_t column) {
  const bool has_header = column < table.headers.size() && !table.headers[column].empty();
  return has_header ? table.headers[column] : table.columns[column].name;
}

/// The first column whose name is the time with its unit: "time_ms", "Time in s".
std::optional<Index> time_with_unit(const Table& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (const auto found = unit_in_name(written_name(table, i));
        found && found->is_of_time && found->is_certain)
      return static_cast<Index>(i);
  return std::nullopt;
}

/// The column called t, time, or one of them in other case, or time with a unit, in this order.
std::optional<Index> time_by_name(const Table& table) {
  const std::vector<std::string> names = names_of(table);
  if (const auto column = find_name(names, "t")) return column;
  std::vector<std::string> lower;
  for (const std::string& name : names) lower.push_back(lower_case(name));
  if (const auto column = find_name(lower, "time")) return column;
  if (const auto column = find_name(lower, "t")) return column;
  return time_with_unit(table);
}

bool contains(const std::vector<Index>& columns, Index column) {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

void check_step(const ColumnRoles& roles) {
  if (!roles.step) return;
  if (!std::isfinite(*roles.step) || *roles.step <= 0.0)
    throw ConfigError("sampling step",
                      "the value " + format_number(*roles.step) + " is not a step in time",
                      "give a number greater than 0");
  if (roles.time)
    throw ConfigError("sampling step",
                      "both a step and the time column '" + *roles.time + "' are given",
                      "leave one of them out");
}

/// Finds the time among the columns that have no other role yet.
void find_time(const Table& table, const ColumnRoles& roles, ColumnIndices& columns) {
  const std::vector<Index> taken = columns.used();
  if (roles.time) columns.time = column_of(table, *roles.time);
  if (roles.time || roles.step) return;
  columns.time = time_by_name(table);
  if (columns.time && !contains(taken, *columns.time)) return;
  columns.time_by_position = true;
  columns.time = 0;
  const auto count = static_cast<Index>(table.columns.size());
  while (*columns.time < count && contains(taken, *columns.time)) ++*columns.time;
  if (*columns.time == count)
    throw DataError(table.source, "every column has another role, none is left for the time",
                    "name the time column (--time NAME) or give the sampling step (--dt 0.01)");
}

/// Names of columns that count samples, not time.
bool is_count(const std::string& name) {
  constexpr std::array<std::string_view, 10> kCounts{"tick",   "ticks",   "frame", "frames",
                                                     "sample", "samples", "index", "counter",
                                                     "cycle",  "cycles"};
  return std::find(kCounts.begin(), kCounts.end(), lower_case(name)) != kCounts.end();
}

/// Finds the unit of the time: in the header, or in the name of its column.
void find_time_unit(const Table& table, const ColumnRoles& roles, ColumnIndices& columns) {
  if (!columns.time || roles.time_unit) return;
  const auto column = static_cast<std::size_t>(*columns.time);
  const std::string& unit = table.columns[column].unit;
  const std::string name = written_name(table, column);
  const auto note = [&](const std::string& text) {
    columns.notes.push_back(table.source + ": " + text);
  };
  const auto named = unit_in_name(name);
  if (!unit.empty()) {
    columns.time_unit = time_unit_symbol(unit).value_or(unit);
    if (named && named->is_certain && named->unit != *columns.time_unit)
      note("the time in column '" + name + "' is taken in its unit " + *columns.time_unit +
           ", not in " + named->unit + " as its name says");
  } else if (named && named->is_certain) {
    columns.time_unit = named->unit;
    note("the time is in " + named->unit + ", as the name of column '" + name + "' says");
  } else if (named && named->unit != "s") {
    note("nobody says the unit of the time in column '" + name + "'; give --time-unit " +
         named->unit + " if that is meant");
  } else if (is_count(name)) {
    note("column '" + name +
         "' is taken as the time; where it counts samples give their step with --dt");
  }
}

/// Every column without a role becomes a state.
void find_states(const Table& table, const ColumnRoles& roles, ColumnIndices& columns) {
  if (!roles.states.empty()) return;
  const std::vector<Index> taken = columns.used();
  const std::optional<Index> unused = roles.step ? time_by_name(table) : std::optional<Index>();
  for (Index column = 0; column < static_cast<Index>(table.columns.size()); ++column) {
    if (contains(taken, column)) continue;
    if (column == unused)
      columns.notes.push_back(table.source + ": column '" + name_of(table, column) +
                              "' is not used, as the sampling step is given");
    else
      columns.states.push_back(column);
  }
}

void check_roles(const Table& table, const ColumnIndices& columns) {
  if (columns.states.empty())
    throw DataError(table.source, "there is no column for a state",
                    "give a file with a time and at least one state, or the sampling step "
                    "(--dt 0.01) when it has no time");
  std::vector<Index> used = columns.used();
  std::sort(used.begin(), used.end());
  const auto twice = std::adjacent_find(used.begin(), used.end());
  if (twice != used.end())
    throw DataError(table.source, "column '" + name_of(table, *twice) + "' is named twice",
                    "give every column one role: time, state, input, derivative or trajectory");
  if (!columns.derivatives.empty() && columns.derivatives.size() != columns.states.size())
    throw DataError(table.source,
                    std::to_string(columns.derivatives.size()) + " derivatives are given for " +
                        std::to_string(columns.states.size()) + " states",
                    "name one column of derivatives for each state, in the same order");
}

Quantity variable_of(const Table& table, Index column, std::vector<std::string>& notes) {
  Quantity quantity = table.columns[static_cast<std::size_t>(column)];
  if (!is_reserved_name(quantity.name)) return quantity;
  notes.push_back(table.source + ": column '" + quantity.name + "' is called '" +
                  quantity.name + "_', the name has a meaning in expressions");
  quantity.name += '_';
  return quantity;
}

/// Values that are no times: what was counted from its first value is as it was written again.
Matrix gather(const Table& table, const TableRows& rows, const std::vector<Index>& columns) {
  Matrix values(rows.count, static_cast<Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    auto column = values.col(static_cast<Index>(i));
    column = table.values.col(columns[i]).segment(rows.first, rows.count);
    if (table.counted && table.counted->column == columns[i])
      column.array() += table.counted->first;
  }
  return values;
}

Vector times_of(const Table& table, const ColumnIndices& columns,
                const std::optional<double>& step, const TableRows& rows) {
  if (columns.time) return table.values.col(*columns.time).segment(rows.first, rows.count);
  Vector time(rows.count);
  for (Index i = 0; i < rows.count; ++i) time[i] = *step * static_cast<double>(rows.offset + i);
  return time;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::vector<Index> ColumnIndices::used() const {
  std::vector<Index> all;
  if (time) all.push_back(*time);
  all.insert(all.end(), states.begin(), states.end());
  all.insert(all.end(), inputs.begin(), inputs.end());
  all.insert(all.end(), derivatives.begin(), derivatives.end());
  if (trajectory) all.push_back(*trajectory);
  return all;
}

ColumnIndices find_columns(const Table& table, const ColumnRoles& roles) {
  check_step(roles);
  if (const auto fault = roles.time_unit ? unit_fault(*roles.time_unit) : std::nullopt)
    throw ConfigError("time unit", fault->problem, fault->remedy);
  ColumnIndices columns;
  columns.states = columns_of(table, roles.states);
  columns.inputs = columns_of(table, roles.inputs);
  columns.derivatives = columns_of(table, roles.derivatives);
  if (roles.trajectory)
    columns.trajectory = column_of(table, *roles.trajectory);
  else if (!table.run_column.empty())
    columns.trajectory = column_of(table, table.run_column);
  find_time(table, roles, columns);
  find_time_unit(table, roles, columns);
  find_states(table, roles, columns);
  check_roles(table, columns);
  return columns;
}

Trajectory take_record(const Table& table, const ColumnIndices& columns,
                       const std::optional<double>& step, const TableRows& rows) {
  check_part(rows.first, rows.count, table.values.rows(), "take_record");
  for (const Index column : columns.used())
    check_number(column, table.values.cols(), "take_record", "column");
  Trajectory record;
  record.source = table.source;
  record.time = times_of(table, columns, step, rows);
  record.states = gather(table, rows, columns.states);
  record.inputs = gather(table, rows, columns.inputs);
  if (!columns.derivatives.empty())
    record.derivatives = gather(table, rows, columns.derivatives);
  return record;
}

namespace {

/// Rows in which all channels have a value, where they have rates or times of their own.
std::optional<Table> rows_of_all(const Table& table, const ColumnIndices& columns) {
  auto common = common_rows(table, columns.used());
  if (common || !columns.time || columns.trajectory) return common;
  std::vector<Index> channels = columns.used();
  std::erase(channels, *columns.time);
  return rows_of_densest(table, *columns.time, channels);
}

}  // namespace

namespace {

/// The rows with the inputs in all of them and, where blanks cut records, with all channels.
Table at_same_times(const Table& given, const ColumnIndices& columns, const ColumnRoles& roles) {
  Table table = with_inputs_everywhere(given, columns, roles);
  if (roles.blanks != Blanks::Cut) return table;
  return at_times_of_densest(table, columns, roles);
}

}  // namespace

Dataset assign_roles(const Table& given, const ColumnRoles& roles) {
  const ColumnIndices columns = find_columns(given, roles);
  std::optional<Table> once;
  if (given.own_times && columns.time)
    once = at_same_times(given, columns, roles);
  else
    once = without_repeated_times(given, columns);
  const Table& distinct = once ? *once : given;
  std::optional<FilledTable> filled;
  if (roles.blanks != Blanks::Cut) filled = fill_blanks(distinct, columns.states);
  std::optional<Table> common;
  if (!filled) common = rows_of_all(distinct, columns);
  const Table& table = filled ? filled->table : common ? *common : distinct;
  Dataset data;
  data.notes = table.notes;
  append(data.notes, columns.notes);
  for (const Index i : columns.states) data.states.push_back(variable_of(table, i, data.notes));
  for (const Index i : columns.inputs) data.inputs.push_back(variable_of(table, i, data.notes));
  if (columns.time_unit) data.time_unit = *columns.time_unit;
  if (roles.time_unit) data.time_unit = *roles.time_unit;
  const Records records = split_records(table, columns, roles.blanks == Blanks::Keep);
  append(data.notes, records.notes);
  std::vector<double> numbers;
  for (const TableRows& rows : records.ranges)
    numbers.push_back(columns.trajectory ? table.values(rows.first, *columns.trajectory) : 0.0);
  const std::vector<std::string> names = names_of_parts(table.source, numbers);
  for (std::size_t i = 0; i < records.ranges.size(); ++i) {
    const TableRows& rows = records.ranges[i];
    Trajectory trajectory = take_record(table, columns, roles.step, rows);
    trajectory.source = names[i];
    if (filled && filled->marks.size() > 0)
      trajectory.marks = filled->marks.middleRows(rows.first, rows.count);
    data.trajectories.push_back(std::move(trajectory));
  }
  return data;
}

}  // namespace lacuna
