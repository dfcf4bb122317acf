// SPDX-License-Identifier: MIT
#include "counted_times.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/text.hpp"
#include "data/records/same_columns.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

struct UnitOfEpoch {
  const char* unit;
  const char* name;
  double seconds;
};

/// Times since 1970 in a unit that is none of seconds are too large for anything else.
void note_epoch(Table& table, const TimeColumn& time, double first) {
  constexpr std::array<UnitOfEpoch, 3> kUnits{{{"ms", "milliseconds", 1e-3},
                                               {"us", "microseconds", 1e-6},
                                               {"ns", "nanoseconds", 1e-9}}};
  constexpr double kYear = 31556952.0;  // seconds
  constexpr double kEarliest = 2000.0, kLatest = 2100.0;
  if (time.has_unit) return;
  for (const UnitOfEpoch& one : kUnits) {
    const double year = 1970.0 + first * one.seconds / kYear;
    if (year < kEarliest || year > kLatest) continue;
    // In front of all others: the answer is in the wrong unit until somebody says it.
    table.notes.insert(table.notes.begin(),
                       table.source + ": its times look like " + one.name +
                          " since 1970 (year " + format_number(std::floor(year)) +
                          "), and nobody says their unit; give --time-unit " + one.unit +
                          " if they are");
  }
}

/// Whether steps vary as those of an even record do whose times are rounded to a resolution:
/// by one unit of it.
bool are_rounded(const std::vector<double>& sorted, double resolution) {
  constexpr std::size_t kFewest = 8;
  if (sorted.size() < kFewest) return false;
  const std::size_t tenth = sorted.size() / 10;
  const double spread = sorted[sorted.size() - 1 - tenth] - sorted[tenth];
  return spread > 0.5 * resolution && spread < 1.5 * resolution;
}

/// @param times counted from the first one.
void note_resolution(Table& table, const TimeColumn& time, std::span<const double> times,
                     double resolution) {
  constexpr double kWorthSaying = 0.01;  // of a step: derivatives are off by as much
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] > times[i - 1]) steps.push_back(times[i] - times[i - 1]);
  std::sort(steps.begin(), steps.end());
  if (!are_rounded(steps, resolution)) return;
  const double fraction = resolution / steps[steps.size() / 2];
  if (fraction < kWorthSaying) return;
  const std::string& name = table.columns[static_cast<std::size_t>(time.column)].name;
  table.notes.push_back(table.source + ": the times in column '" + name + "' are rounded to " +
                        format_number(resolution, 2) + ", " +
                        std::to_string(std::lround(100.0 * fraction)) +
                        " % of their step; write them with more digits, or give the step");
}

}  // namespace

TimeFinder time_finder(const ColumnRoles& roles) {
  return [roles](const Table& columns) -> std::optional<TimeColumn> {
    try {
      Table called = columns;
      for (const auto& [name, column] : roles.names) rename_column(called, name, column);
      name_in_order(called, roles);
      const ColumnIndices found = find_columns(called, roles);
      if (!found.time) return std::nullopt;
      return TimeColumn{*found.time, roles.time_unit || found.time_unit};
    } catch (const Error&) {
      return std::nullopt;  // is said, with all the rest, when the columns get their roles
    }
  };
}

std::optional<Stamp> look_at_times(Table& table, const TimeColumn& time,
                                   std::span<const Stamp> first) {
  if (first.empty()) return std::nullopt;
  note_epoch(table, time, value_of(first.front()));
  std::vector<double> times;
  Stamp unit = kStampOfOne << 64U;
  for (const Stamp stamp : first) {
    times.push_back(value_of(stamp - first.front()));
    if (stamp != 0) unit = std::min(unit, last_digit(stamp));
  }
  note_resolution(table, time, times, value_of(unit));
  const auto origin = origin_of(first);
  if (!origin) return std::nullopt;
  table.counted = CountedColumn{time.column, value_of(*origin)};
  const std::string& name = table.columns[static_cast<std::size_t>(time.column)].name;
  table.notes.push_back(table.source + ": the times in column '" + name +
                        "' are counted from the first one, " + stamp_text(*origin) +
                        ", as doubles do not hold all their digits");
  return origin;
}

void look_at_times(Table& table, const TimeColumn& time, std::span<const double> first,
                   double epsilon) {
  std::vector<double> times;
  double largest = 0.0;
  for (const double value : first) {
    if (!std::isfinite(value)) continue;
    times.push_back(value);
    largest = std::max(largest, std::abs(value));
  }
  if (times.empty()) return;
  note_epoch(table, time, times.front());
  // Distance of floating numbers just below the next power of two.
  const double resolution =
      largest > 0.0 ? std::exp2(std::floor(std::log2(largest))) * epsilon : 0.0;
  note_resolution(table, time, times, resolution);
}

void count_times(Table& table, const TimeColumn& time, const WrittenNumbers& written) {
  const Index rows = table.values.rows(), looked = std::min(rows, kFirstTimes);
  auto column = table.values.col(time.column);
  if (!written.stamp)
    return look_at_times(table, time, {column.data(), static_cast<std::size_t>(looked)},
                         written.epsilon);
  std::vector<Stamp> first;
  for (Index row = 0; row < looked; ++row)
    if (!std::isnan(column[row])) first.push_back(written.stamp(row));
  const auto origin = look_at_times(table, time, first);
  for (Index row = 0; origin && row < rows; ++row)
    if (!std::isnan(column[row])) column[row] = value_of(written.stamp(row) - *origin);
}

}  // namespace lacuna
