// SPDX-License-Identifier: MIT
#include "data/units/in_units.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "core/base/names.hpp"
#include "data/units/units.hpp"

namespace lacuna {
namespace {

/// What becomes of one column.
struct UnitChange {
  Index column = 0;
  UnitConversion conversion;
};

void apply(const UnitChange& change, Matrix& values) {
  if (values.cols() <= change.column) return;
  auto column = values.col(change.column).array();
  column = column * change.conversion.factor + change.conversion.offset;
}

std::string source_of(const Dataset& data) {
  const bool named = !data.trajectories.empty() && !data.trajectories.front().source.empty();
  return named ? file_of(data.trajectories.front()) : "record";
}

/// Gives columns the wanted units; what their values have to become, with notes.
std::vector<UnitChange> changes_of(std::vector<Quantity>& columns,
                                   const std::vector<Quantity>& wanted,
                                   const std::string& source, std::vector<std::string>& notes) {
  std::vector<UnitChange> changes;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    Quantity& column = columns[i];
    const auto found = std::find_if(wanted.begin(), wanted.end(), [&](const Quantity& one) {
      return one.name == column.name;
    });
    if (found == wanted.end() || found->unit.empty() || column.unit.empty()) continue;
    const std::string from = std::exchange(column.unit, found->unit);
    if (const auto change = conversion(from, found->unit)) {
      if (change->changes_nothing()) continue;
      notes.push_back(source + ": " + column.name + " is taken from " + from + " to " +
                      found->unit + " (" + describe(*change) + ")");
      changes.push_back({static_cast<Index>(i), *change});
      continue;
    }
    column.unit = from;
    notes.push_back(source + ": " + column.name + " is in " + from + ", wanted is " +
                    found->unit + "; nothing converts these, its values are taken as they are");
  }
  return changes;
}

}  // namespace

bool do_not_convert(const std::string& from, const std::string& to) {
  return !from.empty() && !to.empty() && !conversion(from, to);
}

Dataset in_units_of(const std::vector<Quantity>& wanted, Dataset data) {
  const std::string source = source_of(data);
  const auto states = changes_of(data.states, wanted, source, data.notes);
  const auto inputs = changes_of(data.inputs, wanted, source, data.notes);
  for (Trajectory& record : data.trajectories) {
    for (const UnitChange& change : states) {
      apply(change, record.states);
      apply({change.column, {change.conversion.factor, 0.0}}, record.derivatives);
    }
    for (const UnitChange& change : inputs) apply(change, record.inputs);
  }
  return data;
}

}  // namespace lacuna
