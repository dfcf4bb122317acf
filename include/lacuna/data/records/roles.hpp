// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// What becomes of a row in which a state has no value and time and inputs have theirs.
enum class Blanks {
  Cut,   ///< it is left out and a new record begins
  Mark,  ///< the state is filled in between its neighbours and marked as missing
  Keep,  ///< the same, and a jump in time begins no new record: samples may be taken at will
};

/// Which column plays which role; what is not said is found by the rules of the data format:
/// time is the column `t`, `time`, `time_ms` or the first one, every other column is a state.
/// A column is named as in the dataset ("Ch_1") or as in the file's header ("Ch 1").
struct ColumnRoles {
  std::optional<std::string> time = {};       ///< name of the time column
  std::optional<double> step = {};            ///< sampling step h; then no column is the time
  std::optional<std::string> time_unit = {};  ///< goes before the unit in the header
  std::vector<std::string> states = {};       ///< empty: all that have no other role
  std::vector<std::string> inputs = {};
  /// Columns that hold dx/dt, in the order of the states.
  std::vector<std::string> derivatives = {};
  std::optional<std::string> trajectory = {};  ///< column that numbers the records in one file
  Blanks blanks = Blanks::Cut;
  /// How columns go on between their samples, which is asked where channels have times of their
  /// own (Table::own_times).
  std::vector<std::pair<std::string, Hold>> holds = {};
  /// Other names for columns, before all else: the new name and the column (rename_column()).
  std::vector<std::pair<std::string, std::string>> names = {};
};

/// Rows first, first + 1, ..., first + count - 1 of a table.
struct TableRows {
  Index first = 0;
  Index count = 0;
  Index offset = 0;  ///< of `first` from the first row with the same trajectory number
};

/// Numbers of the columns that play the roles.
struct ColumnIndices {
  std::optional<Index> time;       ///< nothing when the step is given
  bool time_by_position = false;   ///< the first column, for want of one named t or time
  std::vector<Index> states;       ///< m
  std::vector<Index> inputs;       ///< p
  std::vector<Index> derivatives;  ///< m or none
  std::optional<Index> trajectory;
  std::optional<std::string> time_unit;  ///< in the header or the name of the time, if said
  std::vector<std::string> notes;        ///< columns left out, units: what a user might miss

  /// Every column that has a role, in the order time, states, inputs, derivatives, trajectory.
  std::vector<Index> used() const;
};

/// Finds the columns. When a step is given, a column named `t` or `time` is left out, not a
/// state. The unit of the time is that of its header ("msec" is ms), else the one in its name
/// where that is certain ("time_ms"), which is noted, as is a name that may have one ("t_min").
/// @throws DataError for a name that is no column, a column with two roles, no state, a number
/// of
///   derivatives other than that of the states; ConfigError for a step that is not positive or
///   that comes with a time column.
ColumnIndices find_columns(const Table& table, const ColumnRoles& roles);

/// Gives the columns their roles and cuts the rows into trajectories: a missing value, a jump
/// in time or a new number in the trajectory column starts a new one; each split is noted. Where
/// channels have times of their own, inputs go on between their samples (ColumnRoles::holds);
/// states are marked as missing between theirs or, with Blanks::Cut, brought to the same times. The
/// time unit is the one that is given, else that of the time column, else "s". A state or an
/// input called like a word of the expression language (`t`) gets an underscore, which is
/// noted.
/// @throws DataError for unknown names, time that goes backwards, an infinite value, ...
Dataset assign_roles(const Table& table, const ColumnRoles& roles);

/// Rows of a table as a record.
/// @param step of the samples where no column is the time.
/// @throws ArgumentError when there are no such rows or columns. Missing values are NaN.
Trajectory take_record(const Table& table, const ColumnIndices& columns,
                       const std::optional<double>& step, const TableRows& rows);

}  // namespace lacuna
