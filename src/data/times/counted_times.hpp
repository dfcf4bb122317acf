// SPDX-License-Identifier: MIT
// What the first times of a file show, and times that are counted from the first one.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lacuna/data/records/roles.hpp"
#include "lacuna/data/records/table.hpp"
#include "stamps.hpp"

namespace lacuna {

/// The column that is the time.
struct TimeColumn {
  Index column = 0;
  bool has_unit = false;  ///< which somebody said: the user, or the file
};

/// Finds it among the columns of a table without rows; nothing where there is none, or where
/// roles do not fit the columns, which is said when these are given.
using TimeFinder = std::function<std::optional<TimeColumn>(const Table& columns)>;

/// By roles; their names are given to the columns first.
TimeFinder time_finder(const ColumnRoles& roles);

/// No column is the time: all numbers become doubles as they are.
inline std::optional<TimeColumn> no_time(const Table&) { return std::nullopt; }

/// So many rows at the begin of a file show how its times are written, however it is read.
inline constexpr Index kFirstTimes = 1000;

/// Looks at the first times of a file: notes where they look like times since 1970 in a unit
/// that nobody said, where they are too coarse for their steps, and, with the value itself,
/// where they are counted from the first one, which table.counted says then.
/// @param first as they are written.
/// @return the stamp from which the column is to be counted.
std::optional<Stamp> look_at_times(Table& table, const TimeColumn& time,
                                   std::span<const Stamp> first);

/// The same of times that are floating numbers already, so that nothing can be gained by
/// counting.
/// @param epsilon of their type: 2^-52 for doubles.
void look_at_times(Table& table, const TimeColumn& time, std::span<const double> first,
                   double epsilon);

/// How the numbers of a binary array are written.
struct WrittenNumbers {
  std::function<Stamp(Index row)> stamp = {};  ///< empty for floating numbers
  double epsilon = 0.0;                        ///< of floating numbers
};

/// Looks at the times of a table that is in memory, and counts them where that is needed.
void count_times(Table& table, const TimeColumn& time, const WrittenNumbers& written);

}  // namespace lacuna
