// SPDX-License-Identifier: MIT
#include "blanks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {

FilledTable fill_blanks(Table table, const std::vector<Index>& columns) {
  const Matrix values = table.values(Eigen::all, columns);
  if (!values.array().isNaN().any()) return {std::move(table), {}};
  const Matrix marks =
      (values.array().isNaN())
          .select(Matrix::Constant(values.rows(), values.cols(), number_of(Mark::Missing)),
                  Matrix::Zero(values.rows(), values.cols()));
  table.values(Eigen::all, columns) = filled(values, marks);
  return {std::move(table), marks};
}

namespace {

/// Rows in which all of these columns have a value.
std::vector<Index> complete_rows(const Table& table, const std::vector<Index>& columns) {
  std::vector<Index> rows;
  for (Index i = 0; i < table.values.rows(); ++i)
    if (std::none_of(columns.begin(), columns.end(),
                     [&](Index column) { return std::isnan(table.values(i, column)); }))
      rows.push_back(i);
  return rows;
}

bool any_adjacent(const std::vector<Index>& rows) {
  return std::adjacent_find(rows.begin(), rows.end(), [](Index a, Index b) {
           return b == a + 1;
         }) != rows.end();
}

Table with_rows(const Table& table, const std::vector<Index>& rows) {
  Table part = table;
  part.values = table.values(rows, Eigen::all).eval();
  if (table.lines.empty()) return part;
  part.lines.clear();
  for (const Index row : rows) part.lines.push_back(table.lines[static_cast<std::size_t>(row)]);
  return part;
}

}  // namespace

std::optional<Table> common_rows(const Table& table, const std::vector<Index>& columns) {
  const std::vector<Index> rows = complete_rows(table, columns);
  if (rows.size() < 4 || any_adjacent(rows)) return std::nullopt;
  Table common = with_rows(table, rows);
  common.notes.push_back(table.source + ": channels have rates of their own; the " +
                         std::to_string(rows.size()) + " rows in which all have a value, of " +
                         std::to_string(table.values.rows()) + ", are used");
  return common;
}

std::optional<Table> rows_of_densest(const Table& table, Index time,
                                     const std::vector<Index>& columns) {
  constexpr std::size_t kFewest = 8;  // a decision: a cubic and as many values to see it by
  const auto times = table.values.col(time);
  const bool goes_on = std::is_sorted(times.begin(), times.end(), std::less_equal<>());
  if (!goes_on || any_adjacent(complete_rows(table, columns))) return std::nullopt;
  std::vector<std::vector<Index>> rows;
  Index first = 0, last = table.values.rows() - 1;
  std::size_t densest = 0;
  for (const Index column : columns) {
    rows.push_back(complete_rows(table, {time, column}));
    if (rows.back().size() < kFewest) return std::nullopt;
    first = std::max(first, rows.back().front());
    last = std::min(last, rows.back().back());
    if (rows.back().size() > rows[densest].size()) densest = rows.size() - 1;
  }
  std::vector<Index> used = rows[densest];
  std::erase_if(used, [&](Index row) { return row < first || row > last; });
  if (used.size() < kFewest) return std::nullopt;
  Table even = with_rows(table, used);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    SampledSignal signal(table.values(rows[k], time), table.values(rows[k], columns[k]));
    for (Index i = 0; i < even.values.rows(); ++i)
      even.values(i, columns[k]) = signal(even.values(i, time));
  }
  const std::string& name = table.columns[static_cast<std::size_t>(columns[densest])].name;
  even.notes.push_back(table.source + ": channels have times of their own; the " +
                       std::to_string(used.size()) + " times of '" + name +
                       "' are used, the others interpolated there by cubics");
  return even;
}

}  // namespace lacuna
