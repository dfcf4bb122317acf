// SPDX-License-Identifier: MIT
#include "data/records/repeated_times.hpp"

#include <string>
#include <vector>

namespace lacuna {

std::optional<Table> without_repeated_times(const Table& table, const ColumnIndices& columns) {
  // Loggers repeat a stamp where two samples fall into one tick. With twice as many the clock
  // is too coarse for its samples, with half of it records of 60 rows have no such sample.
  constexpr double kMost = 0.02;
  if (!columns.time) return std::nullopt;
  const auto time = table.values.col(*columns.time);
  std::vector<Index> kept;
  Index first = -1;  // row that is left out
  for (Index row = 0; row < time.size(); ++row) {
    const bool same_record =
        !columns.trajectory || (row > 0 && table.values(row, *columns.trajectory) ==
                                               table.values(row - 1, *columns.trajectory));
    if (row > 0 && time[row] == time[row - 1] && same_record)
      first = first < 0 ? row : first;
    else
      kept.push_back(row);
  }
  const Index repeated = time.size() - static_cast<Index>(kept.size());
  if (repeated == 0 || static_cast<double>(repeated) > kMost * static_cast<double>(time.size()))
    return std::nullopt;
  Table distinct = table;
  distinct.values = table.values(kept, Eigen::all).eval();
  for (std::size_t i = 0; i < kept.size() && !table.lines.empty(); ++i)
    distinct.lines[i] = table.lines[static_cast<std::size_t>(kept[i])];
  if (!table.lines.empty()) distinct.lines.resize(kept.size());
  distinct.notes.push_back(place(table, first, *columns.time) + ": " + std::to_string(repeated) +
                           (repeated == 1 ? " row has" : " rows have") +
                           " the time of the row before, left out");
  return distinct;
}

}  // namespace lacuna
