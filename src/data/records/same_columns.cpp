// SPDX-License-Identifier: MIT
#include "same_columns.hpp"

#include <algorithm>
#include <vector>

#include "core/base/names.hpp"
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

namespace {

/// Whether some column is called otherwise than by its number.
bool has_names(const Table& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const bool has_header = i < table.headers.size() && !table.headers[i].empty();
    if (has_header || table.columns[i].name != "c" + std::to_string(i + 1)) return true;
  }
  return false;
}

}  // namespace

void name_in_order(Table& table, const ColumnRoles& roles) {
  std::vector<std::string> names;
  if (roles.time) names.push_back(*roles.time);
  for (const auto* more : {&roles.states, &roles.inputs, &roles.derivatives})
    names.insert(names.end(), more->begin(), more->end());
  const bool time_leads =
      !roles.time && !roles.step && names.size() + 1 == table.columns.size();
  if (has_names(table) || (names.size() != table.columns.size() && !time_leads)) return;
  if (time_leads) names.insert(names.begin(), "t");
  const auto is_usable = [&](const std::string& name) {
    const bool is_column =
        std::any_of(table.columns.begin(), table.columns.end(),
                    [&](const Quantity& column) { return column.name == name; });
    return !is_column && (name == "t" || !name_fault(name)) &&
           std::count(names.begin(), names.end(), name) == 1;
  };
  if (!std::all_of(names.begin(), names.end(), is_usable)) return;
  for (std::size_t i = 0; i < names.size(); ++i) table.columns[i].name = names[i];
  table.notes.push_back(table.source + ": its columns have no names and are called " +
                        join(names, ", ") + ", in this order");
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
