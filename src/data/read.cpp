// SPDX-License-Identifier: MIT
#include "lacuna/data/read.hpp"

#include <glob.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "file_kinds.hpp"
#include "hdf5.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/core/file_bytes.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/data/read_text.hpp"
#include "lacuna/data/text_field.hpp"
#include "mat.hpp"
#include "npy.hpp"
#include "npz.hpp"

namespace lacuna {
namespace {

namespace fs = std::filesystem;

/// Whether the name ends in an ending such as .npy, or in that and .gz.
bool is_named(const fs::path& path, std::string_view ending) {
  fs::path name = path.filename();
  if (lower_case(name.extension().string()) == ".gz") name = name.stem();
  return lower_case(name.extension().string()) == ending;
}

/// @throws DataError for well-known binary formats that cannot be read.
void check_format(std::string_view bytes, const std::string& source) {
  if (const auto kind = known_file(bytes))
    throw DataError(source, "this is " + kind->what + ", which cannot be read", kind->remedy);
}

/// Version of a MATLAB file, as the two bytes behind its text say; 0 where it is none.
int mat_version(std::string_view bytes) {
  const std::string_view mark = bytes.substr(std::min<std::size_t>(bytes.size(), 124), 4);
  if (mark == std::string_view("\0\1IM", 4) || mark == std::string_view("\1\0MI", 4)) return 5;
  if (mark == std::string_view("\0\2IM", 4) || mark == std::string_view("\2\0MI", 4)) return 7;
  return 0;
}

/// A MATLAB file of version 5 is read by its name, not from memory.
/// @throws DataError where there is no such name.
Table read_named_mat(const fs::path& path) {
  if (path == "-" || lower_case(path.extension().string()) == ".gz")
    throw DataError(path.string(), "a MATLAB file can be read neither from a pipe nor packed",
                    "unpack it and give its name");
  return read_mat(path);
}

bool is_pattern(const std::string& path) {
  std::error_code ignored;
  return path.find_first_of("*?[") != std::string::npos && !fs::exists(path, ignored);
}

std::vector<std::string> matching_files(const std::string& pattern) {
  glob_t found{};
  const std::unique_ptr<glob_t, decltype(&globfree)> guard(&found, &globfree);
  if (glob(pattern.c_str(), 0, nullptr, &found) != 0 || found.gl_pathc == 0)
    throw DataError(pattern, "no file matches this pattern",
                    "check the folder and the names; quote the pattern as it stands");
  return {found.gl_pathv, found.gl_pathv + found.gl_pathc};
}

}  // namespace

std::vector<std::string> expand_patterns(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::vector<std::string> more =
        is_pattern(path) ? matching_files(path) : std::vector<std::string>{path};
    std::move(more.begin(), more.end(), std::back_inserter(files));
  }
  if (files.empty()) throw DataError("data", "no file is given", "name at least one file");
  return files;
}

namespace {

std::vector<std::string> sorted_names(const Table& table) {
  std::vector<std::string> names;
  for (const Quantity& column : table.columns) names.push_back(column.name);
  std::sort(names.begin(), names.end());
  return names;
}

/// @throws DataError when the file has other columns than the first one.
void check_same_columns(const Table& first, const Table& other) {
  const std::vector<std::string> expected = sorted_names(first);
  const std::vector<std::string> found = sorted_names(other);
  if (expected == found) return;
  throw DataError(other.source,
                  "its columns (" + join(found, ", ") + ") are not those of " + first.source +
                      " (" + join(expected, ", ") + ")",
                  "give files with the same columns, or read them apart");
}

std::string unit_text(const std::string& unit) { return unit.empty() ? "none" : unit; }

void check_same_unit(const std::string& source, const std::string& name,
                     const std::string& expected, const std::string& found,
                     const std::string& first) {
  if (expected == found) return;
  throw DataError(source,
                  "the unit of '" + name + "' is " + unit_text(found) + ", in " + first +
                      " it is " + unit_text(expected),
                  "bring both files to the same unit");
}

/// Roles by name as the first file has them, so that the order of columns may differ in others.
ColumnRoles fixed_roles(const Table& first, const ColumnRoles& roles) {
  const ColumnIndices columns = find_columns(first, roles);
  const auto name = [&](Index column) {
    return first.columns[static_cast<std::size_t>(column)].name;
  };
  ColumnRoles fixed = roles;
  if (columns.time && !columns.time_by_position) fixed.time = name(*columns.time);
  fixed.states.clear();
  for (const Index column : columns.states) fixed.states.push_back(name(column));
  return fixed;
}

void append(Dataset& data, Dataset more, const std::string& source, const std::string& first) {
  check_same_unit(source, "time", data.time_unit, more.time_unit, first);
  for (std::size_t i = 0; i < data.states.size(); ++i)
    check_same_unit(source, data.states[i].name, data.states[i].unit, more.states[i].unit,
                    first);
  for (std::size_t i = 0; i < data.inputs.size(); ++i)
    check_same_unit(source, data.inputs[i].name, data.inputs[i].unit, more.inputs[i].unit,
                    first);
  std::move(more.trajectories.begin(), more.trajectories.end(),
            std::back_inserter(data.trajectories));
  std::move(more.notes.begin(), more.notes.end(), std::back_inserter(data.notes));
}

}  // namespace

Table read_table(const fs::path& path) {
  const bool piped = path == "-";
  const FileBytes content = read_bytes(piped ? fs::path("/dev/stdin") : path);
  const std::string_view bytes = content.view();
  const std::string source = piped ? "standard input" : path.string();
  const auto begins = [&](std::string_view mark) { return bytes.starts_with(mark); };
  if (is_named(path, ".npy") || begins("\x93NUMPY")) return parse_npy(bytes, source);
  if (is_named(path, ".npz")) return parse_npz(bytes, source);
  const int mat = mat_version(bytes);
  if (mat == 7 || begins("\x89HDF\r\n\x1a\n")) return parse_hdf5(bytes, source);
  if (mat == 5) return read_named_mat(path);
  check_format(bytes, source);
  return parse_text_table(bytes, source);
}

Table read_table(const fs::path& path, const ColumnRoles& roles) {
  Table table = read_table(path);
  for (const auto& [name, column] : roles.names) rename_column(table, name, column);
  return table;
}

Dataset read_dataset(const std::vector<std::string>& paths, const ColumnRoles& roles) {
  const std::vector<std::string> files = expand_patterns(paths);
  Table first = read_table(files.front(), roles);
  Dataset data = assign_roles(first, roles);
  if (files.size() == 1) return data;
  const ColumnRoles fixed = fixed_roles(first, roles);
  first.values.resize(0, 0);  // only its columns are looked at from here on
  for (std::size_t i = 1; i < files.size(); ++i) {
    const Table table = read_table(files[i], roles);
    check_same_columns(first, table);
    append(data, assign_roles(table, fixed), table.source, first.source);
  }
  return data;
}

}  // namespace lacuna
