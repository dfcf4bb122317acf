// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/data/dataset.hpp"
#include "lacuna/data/table.hpp"

namespace lacuna {

/// Which column plays which role; what is not said is found by the rules of the data format:
/// time is the column `t`, `time` or the first one, every other column is a state.
struct ColumnRoles {
  std::optional<std::string> time;        ///< name of the time column
  std::optional<double> step;             ///< sampling step h; then no column is the time
  std::vector<std::string> states;        ///< empty: all that have no other role
  std::vector<std::string> inputs;
  std::vector<std::string> derivatives;   ///< columns that hold dx/dt, in the order of the states
  std::optional<std::string> trajectory;  ///< column that numbers the records in one file
};

/// Reads one file as a table: text (.csv, .txt, .tsv, ..., also .gz) or NumPy .npy, chosen by
/// the ending of its name.
/// @throws FileError when it cannot be opened; DataError naming file, line and column.
Table read_table(const std::filesystem::path& path);

/// Gives the columns their roles and cuts the rows into trajectories: a missing value, a jump in
/// time or a new number in the trajectory column starts a new one; each split is noted.
/// @throws DataError for unknown names, time that goes backwards, an infinite value, ...
Dataset assign_roles(const Table& table, const ColumnRoles& roles);

/// Reads files (paths or shell-like patterns such as "run*.csv") into one dataset.
/// All must have the same columns.
/// @throws FileError, DataError as above; DataError when a pattern matches no file.
Dataset read_dataset(const std::vector<std::string>& paths, const ColumnRoles& roles = {});

}  // namespace lacuna
