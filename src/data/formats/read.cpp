// SPDX-License-Identifier: MIT
#include "lacuna/data/formats/read.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/logs/joined_tables.hpp"
#include "data/records/columns/derivative_columns.hpp"
#include "data/records/same_columns.hpp"
#include "data/records/text_field.hpp"
#include "data/sheets/workbook.hpp"
#include "data/units/in_units.hpp"
#include "file_kinds.hpp"
#include "hdf5.hpp"
#include "joined_files.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/types.hpp"
#include "mat.hpp"
#include "npy.hpp"
#include "npz.hpp"
#include "text_rows.hpp"

namespace lacuna {
namespace {

namespace fs = std::filesystem;

/// A MATLAB file of version 5 is read by its name, not from memory.
/// @throws DataError where there is no such name.
Table read_named_mat(const fs::path& path, const TimeFinder& find) {
  if (path == "-" || lower_case(path.extension().string()) == ".gz")
    throw DataError(path.string(), "a MATLAB file can be read neither from a pipe nor packed",
                    "unpack it and give its name");
  return read_mat(path, find);
}

/// The files that a pattern stands for; the path itself where it is none.
std::vector<std::string> expanded(const std::string& path) {
  std::vector<std::string> files = files_that_match(path);
  if (!files.empty()) return files;
  const std::vector<std::string> joined = joined_files(path);
  if (joined.size() > 1) return {join(joined, "+")};
  std::error_code ignored;
  if (path.find_first_of("*?[") != std::string::npos && !fs::exists(path, ignored))
    throw DataError(path, "no file matches this pattern",
                    "check the folder and the names; quote the pattern as it stands");
  return {path};
}

}  // namespace

std::vector<std::string> expand_patterns(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::vector<std::string> more = expanded(path);
    std::move(more.begin(), more.end(), std::back_inserter(files));
  }
  if (files.empty()) throw DataError("data", "no file is given", "name at least one file");
  return files;
}

std::vector<std::string> single_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : expand_patterns(paths))
    for (std::string& file : joined_files(path)) files.push_back(std::move(file));
  return files;
}

namespace {

void append(Dataset& data, Dataset more) {
  std::move(more.trajectories.begin(), more.trajectories.end(),
            std::back_inserter(data.trajectories));
  std::move(more.notes.begin(), more.notes.end(), std::back_inserter(data.notes));
}

}  // namespace

namespace {

Table read_any(const fs::path& named, const TimeFinder& find) {
  const auto [path, sheet] = file_and_sheet(named);
  const bool piped = path == "-";
  const FileBytes content = read_bytes(piped ? fs::path("/dev/stdin") : path);
  const std::string_view bytes = content.view();
  const std::string source = piped ? "standard input" : named.string();
  const FileKind kind = kind_of(path, bytes, source);
  check_sheet(sheet, kind, source);
  switch (kind) {
    case FileKind::Npy:
      return parse_npy(bytes, source, find);
    case FileKind::Npz:
      return parse_npz(bytes, source, find);
    case FileKind::Mat:
      return read_named_mat(path, find);
    case FileKind::Hdf5:
      return parse_hdf5(bytes, source, find);
    case FileKind::Workbook:
      return parse_text(sheet_text(bytes, sheet, source), source, find);
    case FileKind::Text:
      break;
  }
  return parse_text(bytes, source, find);
}

}  // namespace

Table read_table(const fs::path& path) {
  if (joined_files(path.string()).size() > 1) return read_table(path, ColumnRoles{});
  return read_any(path, no_time);
}

namespace {

/// Without derivatives among the states, where nothing says which columns are states.
Dataset with_own_states(Dataset data, const ColumnRoles& roles) {
  if (!roles.states.empty() || !roles.derivatives.empty()) return data;
  return without_derivative_columns(std::move(data));
}

/// Tables one behind another; of the first only the columns are kept.
Dataset joined(std::size_t count,
               FunctionRef<Table(std::size_t number, const ColumnRoles& roles)> table_at,
               const ColumnRoles& roles) {
  Table first = table_at(0, roles);
  Dataset data = assign_roles(first, roles);
  if (count == 1) return data;
  const ColumnRoles fixed = fixed_roles(first, roles);
  std::vector<Quantity> quantities = data.states;
  quantities.insert(quantities.end(), data.inputs.begin(), data.inputs.end());
  first.values.resize(0, 0);  // only its columns are looked at from here on
  for (std::size_t i = 1; i < count; ++i) {
    const Table table = table_at(i, fixed);
    check_same_columns(first, table);
    Dataset more = in_units_of(quantities, assign_roles(table, fixed));
    check_same_units(data, more, table.source, first.source);
    append(data, std::move(more));
  }
  return data;
}

}  // namespace

Table renamed(Table table, const ColumnRoles& roles) {
  if (static_cast<Index>(table.columns.size()) != table.values.cols())
    throw DataError(table.source,
                    "it has " + std::to_string(table.columns.size()) + " names for " +
                        std::to_string(table.values.cols()) + " columns",
                    "give one name for each column");
  for (const auto& [name, column] : roles.names) rename_column(table, name, column);
  name_in_order(table, roles);
  return table;
}

Table read_table(const fs::path& path, const ColumnRoles& roles) {
  const std::vector<std::string> files = joined_files(path.string());
  if (files.size() == 1) return renamed(read_any(path, time_finder(roles)), roles);
  std::vector<Table> tables;
  const TimeFinder find = time_finder_of_part(roles);
  for (const std::string& file : files) tables.push_back(read_any(file, find));
  return renamed(joined_on_time(std::move(tables), roles), roles);
}

Dataset read_dataset(const std::vector<std::string>& paths, const ColumnRoles& roles) {
  const std::vector<std::string> files = expand_patterns(paths);
  const auto table_at = [&](std::size_t number, const ColumnRoles& its_roles) {
    return read_table(files[number], its_roles);
  };
  return with_own_states(joined(files.size(), table_at, roles), roles);
}

Dataset dataset_of_tables(std::vector<Table> tables, const ColumnRoles& roles) {
  if (tables.empty())
    throw DataError("data", "there is no record", "give at least one table of samples");
  const auto table_at = [&](std::size_t number, const ColumnRoles& its_roles) {
    return renamed(std::move(tables[number]), its_roles);
  };
  return with_own_states(joined(tables.size(), table_at, roles), roles);
}

}  // namespace lacuna
