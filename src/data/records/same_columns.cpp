// SPDX-License-Identifier: MIT
#include "same_columns.hpp"

#include <algorithm>
#include <vector>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

std::vector<std::string> sorted_names(const Table& table) {
  std::vector<std::string> names;
  for (const Quantity& column : table.columns) names.push_back(column.name);
  std::sort(names.begin(), names.end());
  return names;
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

}  // namespace

void check_same_columns(const Table& first, const Table& other) {
  const std::vector<std::string> expected = sorted_names(first);
  const std::vector<std::string> found = sorted_names(other);
  if (expected == found) return;
  throw DataError(other.source,
                  "its columns (" + join(found, ", ") + ") are not those of " + first.source +
                      " (" + join(expected, ", ") + ")",
                  "give files with the same columns, or read them apart");
}

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

void check_same_units(const Dataset& data, const Dataset& more, const std::string& source,
                      const std::string& first) {
  check_same_unit(source, "time", data.time_unit, more.time_unit, first);
  for (std::size_t i = 0; i < data.states.size(); ++i)
    check_same_unit(source, data.states[i].name, data.states[i].unit, more.states[i].unit,
                    first);
  for (std::size_t i = 0; i < data.inputs.size(); ++i)
    check_same_unit(source, data.inputs[i].name, data.inputs[i].unit, more.inputs[i].unit,
                    first);
}

}  // namespace lacuna
