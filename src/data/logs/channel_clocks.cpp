// SPDX-License-Identifier: MIT
#include "data/logs/channel_clocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

bool is_further(Index column, const std::vector<Index>& clocks) {
  return std::find(clocks.begin() + 1, clocks.end(), column) != clocks.end();
}

/// All columns but those of further clocks.
std::vector<Index> kept_columns(Index count, const std::vector<Index>& clocks) {
  std::vector<Index> kept;
  for (Index column = 0; column < count; ++column)
    if (!is_further(column, clocks)) kept.push_back(column);
  return kept;
}

/// The clock of a column: the last one in front of it.
Index clock_of(Index column, const std::vector<Index>& clocks) {
  const auto behind = std::upper_bound(clocks.begin(), clocks.end(), column);
  return behind == clocks.begin() ? clocks.front() : *std::prev(behind);
}

/// Rows of one clock at which a new time stands.
/// @throws DataError where it is before the last one.
std::vector<Index> rows_of_clock(const Table& table, Index clock) {
  std::vector<Index> rows;
  double last = -std::numeric_limits<double>::infinity();
  for (Index row = 0; row < table.values.rows(); ++row) {
    const double time = table.values(row, clock);
    if (time < last)
      throw DataError(place(table, row, clock), "the time of this channel goes backwards",
                      "give the file of one run, or sort its rows");
    if (std::isnan(time) || time == last) continue;
    rows.push_back(row);
    last = time;
  }
  return rows;
}

}  // namespace

bool are_one_clock(const Table& table, const std::vector<Index>& clocks) {
  return std::all_of(clocks.begin() + 1, clocks.end(), [&](Index clock) {
    const auto times = table.values.col(clock), first = table.values.col(clocks.front());
    return (times.array().isNaN() || times.array() == first.array()).all();
  });
}

Table without_further_clocks(Table table, const std::vector<Index>& clocks) {
  const auto count = static_cast<Index>(table.columns.size());
  const std::vector<Index> kept = kept_columns(count, clocks);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto from = static_cast<std::size_t>(kept[i]);
    table.columns[i] = table.columns[from];
    if (from < table.headers.size()) table.headers[i] = table.headers[from];
  }
  table.columns.resize(kept.size());
  table.headers.resize(std::min(table.headers.size(), kept.size()));
  if (table.values.cols() == count) table.values = table.values(Eigen::all, kept).eval();
  return table;
}

Table with_one_clock(const Table& table, const std::vector<Index>& clocks) {
  if (are_one_clock(table, clocks)) return without_further_clocks(table, clocks);
  std::vector<std::vector<Index>> rows;
  std::vector<double> times;
  for (const Index clock : clocks) {
    rows.push_back(rows_of_clock(table, clock));
    for (const Index row : rows.back()) times.push_back(table.values(row, clock));
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  Table joined = table;
  const auto count = static_cast<Index>(times.size());
  joined.values = Matrix::Constant(count, table.values.cols(), kMissing);
  joined.lines.assign(table.lines.empty() ? 0 : times.size(), 0);
  joined.values.col(clocks.front()) = Eigen::Map<const Vector>(times.data(), count);
  for (std::size_t k = 0; k < clocks.size(); ++k) {
    auto at = times.begin();
    for (const Index row : rows[k]) {
      at = std::lower_bound(at, times.end(), table.values(row, clocks[k]));
      const Index to = at - times.begin();
      for (Index column = 0; column < table.values.cols(); ++column)
        if (clock_of(column, clocks) == clocks[k] && column != clocks[k])
          joined.values(to, column) = table.values(row, column);
      if (!table.lines.empty() && joined.lines[static_cast<std::size_t>(to)] == 0)
        joined.lines[static_cast<std::size_t>(to)] = table.lines[static_cast<std::size_t>(row)];
    }
  }
  return without_further_clocks(std::move(joined), clocks);
}

}  // namespace lacuna
