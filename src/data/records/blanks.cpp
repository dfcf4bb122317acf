// SPDX-License-Identifier: MIT
#include "blanks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

std::optional<Table> common_rows(const Table& table, const std::vector<Index>& columns) {
  std::vector<Index> rows;
  for (Index i = 0; i < table.values.rows(); ++i) {
    const bool complete = std::none_of(columns.begin(), columns.end(), [&](Index column) {
      return std::isnan(table.values(i, column));
    });
    if (!complete) continue;
    if (!rows.empty() && rows.back() == i - 1) return std::nullopt;
    rows.push_back(i);
  }
  if (rows.size() < 4) return std::nullopt;
  Table common = table;
  common.values = table.values(rows, Eigen::all).eval();
  for (std::size_t i = 0; i < rows.size() && !table.lines.empty(); ++i)
    common.lines[i] = table.lines[static_cast<std::size_t>(rows[i])];
  if (!table.lines.empty()) common.lines.resize(rows.size());
  common.notes.push_back(table.source + ": channels have rates of their own; the " +
                         std::to_string(rows.size()) + " rows in which all have a value, of " +
                         std::to_string(table.values.rows()) + ", are used");
  return common;
}

}  // namespace lacuna
