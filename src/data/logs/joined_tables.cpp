// SPDX-License-Identifier: MIT
#include "data/logs/joined_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/text.hpp"
#include "core/statistics/robust_statistics.hpp"
#include "data/logs/channel_clocks.hpp"
#include "data/units/units.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

constexpr double kBlank = std::numeric_limits<double>::quiet_NaN();

/// A table with its time.
struct TimedTable {
  Table table;
  Index time = 0;
  std::optional<std::string> unit = {};
};

/// Whether a column has a name, or a header.
bool is_called(const Table& table, std::size_t column, const std::string& name) {
  return table.columns[column].name == name ||
         (column < table.headers.size() && table.headers[column] == name);
}

bool has_column(const Table& table, const std::string& name) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (is_called(table, i, name)) return true;
  return false;
}

/// What roles say of the time of one of the tables; numbers of columns are those of all.
ColumnRoles time_roles(const Table& table, const ColumnRoles& roles) {
  ColumnRoles own;
  own.time_unit = roles.time_unit;
  if (roles.time && has_column(table, *roles.time)) own.time = roles.time;
  for (const auto& [name, column] : roles.names)
    if (has_column(table, column)) own.names.emplace_back(name, column);
  return own;
}

TimedTable timed(Table table, const ColumnRoles& roles) {
  if (roles.step)
    throw ConfigError("--dt", "files are joined on their times", "leave it out");
  if (roles.trajectory || !table.run_column.empty())
    throw DataError(table.source, "the records of joined files are not numbered",
                    "join the files of each run, and give the runs one by one");
  const ColumnRoles own = time_roles(table, roles);
  Table called = table;
  for (const auto& [name, column] : own.names) rename_column(called, name, column);
  const ColumnIndices columns = find_columns(called, own);
  const Index time = *columns.time;
  for (Index row = 1; row < table.values.rows(); ++row)
    if (table.values(row, time) < table.values(row - 1, time))
      throw DataError(place(table, row, time), "time goes backwards",
                      "sort the lines by time; files are joined on it");
  auto unit = roles.time_unit ? roles.time_unit : columns.time_unit;
  return {std::move(table), time, std::move(unit)};
}

/// How far the times of a table are from those of the first one, in its own unit.
double start_of(const TimedTable& one) {
  if (one.table.clock_start) return *one.table.clock_start;
  const auto& counted = one.table.counted;
  return counted && counted->column == one.time ? counted->first : 0.0;
}

/// Brings the times of a table to the unit and the begin of those of the first one.
void bring_to(const TimedTable& first, const std::string& unit, TimedTable& one) {
  if (one.table.clock_start.has_value() != first.table.clock_start.has_value())
    throw DataError(one.table.source,
                    std::string("its times are ") + (one.table.clock_start ? "" : "not ") +
                        "those of a clock, unlike those of " + first.table.source,
                    "write both as numbers from one origin");
  double factor = 1.0;
  if (one.unit && !unit.empty()) {
    const auto change = conversion(*one.unit, unit);
    if (!change)
      throw DataError(one.table.source,
                      "its time is in " + *one.unit + ", that of the first file in " + unit,
                      "give both in units of time");
    factor = change->factor;
  } else if (!unit.empty()) {
    one.table.notes.push_back(one.table.source +
                              ": its time has no unit and is taken to be in " + unit +
                              ", as that of the file joined with it");
  }
  auto times = one.table.values.col(one.time).array();
  times = factor * times + (factor * start_of(one) - start_of(first));
}

std::vector<double> times_of(const TimedTable& one) {
  std::vector<double> times;
  for (const double time : one.table.values.col(one.time))
    if (std::isfinite(time)) times.push_back(time);
  return times;
}

double usual_step(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] > times[i - 1]) steps.push_back(times[i] - times[i - 1]);
  return steps.empty() ? 0.0 : upper_median(std::move(steps));
}

/// Times that are those of the first table but for the digits of units become these.
void snap_to(const std::vector<double>& first, TimedTable& one) {
  constexpr double kSame = 1e-3;  // a fact of digits: of the smaller step, no motion
  const double near = kSame * std::min(usual_step(first), usual_step(times_of(one)));
  for (double& time : one.table.values.col(one.time)) {
    const auto behind = std::lower_bound(first.begin(), first.end(), time);
    if (behind != first.end() && *behind - time <= near)
      time = *behind;
    else if (behind != first.begin() && time - *std::prev(behind) <= near)
      time = *std::prev(behind);
  }
}

void check_overlap(const TimedTable& first, const TimedTable& one) {
  const std::vector<double> a = times_of(first), b = times_of(one);
  if (a.empty() || b.empty()) return;  // is said of columns without values
  if (a.front() <= b.back() && b.front() <= a.back()) return;
  const auto range = [](const std::vector<double>& times) {
    return format_number(times.front()) + " to " + format_number(times.back());
  };
  throw DataError(one.table.source,
                  "its times, " + range(b) + ", have none in common with those of " +
                      first.table.source + ", " + range(a),
                  "bring both to one origin");
}

void check_names(const Table& joined, const std::vector<std::string>& sources) {
  for (std::size_t i = 0; i < joined.columns.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (!joined.columns[i].name.empty() &&
          joined.columns[i].name == joined.columns[k].name)
        throw DataError(joined.source,
                        "'" + joined.columns[i].name + "' stands in " + sources[k] + " and in " +
                            sources[i],
                        "rename it in one of them, or take it out there");
}

/// Columns of one table beside those of the others, its time in front of them; rows below.
/// @param sources gets the file of each column.
void put_beside(const TimedTable& one, Index row, Table& joined,
                std::vector<std::string>& sources) {
  const auto first = static_cast<Index>(joined.columns.size());
  std::vector<Index> order{one.time};
  for (Index i = 0; i < static_cast<Index>(one.table.columns.size()); ++i)
    if (i != one.time) order.push_back(i);
  const auto width = static_cast<Index>(order.size());
  joined.values.block(row, first, one.table.values.rows(), width) =
      one.table.values(Eigen::all, order);
  for (const Index column : order) {
    const auto i = static_cast<std::size_t>(column);
    const std::string header = i < one.table.headers.size() ? one.table.headers[i] : "";
    const bool has_name =
        !header.empty() || one.table.columns[i].name != "c" + std::to_string(i + 1);
    joined.columns.push_back(one.table.columns[i]);
    joined.headers.push_back(header);
    sources.push_back(one.table.source);
    if (!has_name) joined.columns.back().name = "c" + std::to_string(joined.columns.size());
  }
  joined.notes.insert(joined.notes.end(), one.table.notes.begin(), one.table.notes.end());
}

}  // namespace

TimeFinder time_finder_of_part(const ColumnRoles& roles) {
  return [roles](const Table& columns) {
    return time_finder(time_roles(columns, roles))(columns);
  };
}

Table joined_on_time(std::vector<Table> tables, const ColumnRoles& roles) {
  std::vector<TimedTable> all;
  Index rows = 0, columns = 0;
  for (Table& table : tables) {
    all.push_back(timed(std::move(table), roles));
    rows += all.back().table.values.rows();
    columns += all.back().table.values.cols();
  }
  std::string unit;
  for (const TimedTable& one : all)
    if (unit.empty() && one.unit) unit = *one.unit;
  const TimedTable first = all.front();
  for (TimedTable& one : all) bring_to(first, unit, one);
  const std::vector<double> times = times_of(all.front());
  for (std::size_t i = 1; i < all.size(); ++i) {
    check_overlap(all.front(), all[i]);
    snap_to(times, all[i]);
  }
  Table joined;
  joined.values = Matrix::Constant(rows, columns, kBlank);
  std::vector<std::string> names, sources;
  std::vector<Index> clocks;
  Index row = 0;
  for (const TimedTable& one : all) {
    clocks.push_back(static_cast<Index>(joined.columns.size()));
    put_beside(one, row, joined, sources);
    row += one.table.values.rows();
    names.push_back(one.table.source);
  }
  for (const Index clock : clocks)  // all but the first go
    if (clock > 0) joined.columns[static_cast<std::size_t>(clock)].name.clear();
  joined.source = join(names, "+");
  check_names(joined, sources);
  if (roles.time && !has_column(joined, *roles.time)) joined.headers.front() = *roles.time;
  joined.columns.front().unit = unit;
  if (first.table.counted) joined.counted = CountedColumn{0, first.table.counted->first};
  joined.clock_start = first.table.clock_start;
  joined = with_one_clock(joined, clocks);
  joined.own_times = true;
  return joined;
}

}  // namespace lacuna
