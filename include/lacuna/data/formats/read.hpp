// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/roles.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// Reads one file as a table: text (.csv, .txt, .tsv, ..., also .gz) or NumPy .npy, chosen by
/// the ending of its name; or files of one run, "a.csv+b.csv", joined on time: a row for each
/// time of any of them, in which the channels that have no sample then are missing
/// (Table::own_times). A name that holds a `+` and is there is that file.
/// @throws FileError when it cannot be opened; DataError naming file, line and column.
Table read_table(const std::filesystem::path& path);

/// The same with columns called as ColumnRoles::names says and with the time counted from its
/// first value where doubles do not hold its digits (19-digit nanoseconds, microseconds since
/// 1970), which Table::counted and a note say.
Table read_table(const std::filesystem::path& path, const ColumnRoles& roles);

/// The table with columns called as ColumnRoles::names says; what is not there stays NaN.
/// @throws DataError as rename_column(), and where names and columns are not as many.
Table renamed(Table table, const ColumnRoles& roles);

/// Paths with each pattern ("run*.csv") replaced by the files that match it, in the order of
/// their names. What exists as it is written is no pattern. In "a*.csv+b.csv", files that are
/// joined (read_table()), a pattern is the one file that it matches.
/// @throws DataError when a pattern matches no file or no path is given.
std::vector<std::string> expand_patterns(const std::vector<std::string>& paths);

/// Reads files (paths or shell-like patterns such as "run*.csv") into one dataset.
/// All must have the same columns, in any order; the first file sets their order and units.
/// A pattern stands for the files that match it, in the order of their names.
/// Where no column is named as a state or a derivative, columns that are the derivatives of
/// others by name and by values ("dx/dt", "x_dot") and no states of their own are left out,
/// which a note says.
/// @throws FileError, DataError as above; DataError when a pattern matches no file.
Dataset read_dataset(const std::vector<std::string>& paths, const ColumnRoles& roles = {});

/// The same of tables that are in memory: from another program, say.
/// @throws DataError as assign_roles(), for tables of other columns than the first one, for
/// none.
Dataset dataset_of_tables(std::vector<Table> tables, const ColumnRoles& roles = {});

}  // namespace lacuna
