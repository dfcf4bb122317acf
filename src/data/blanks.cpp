// SPDX-License-Identifier: MIT
#include "blanks.hpp"

#include <cmath>
#include <utility>

#include "lacuna/data/marks.hpp"

namespace lacuna {
namespace {

/// Fills rows (before, behind) of a column, which has a value at one end at least; rows -1 and
/// n have none.
void fill_between(Index before, Index behind, Eigen::Ref<Vector> values) {
  const bool from = before >= 0, to = behind < values.size();
  const double first = values[from ? before : behind];
  const double last = values[to ? behind : before];
  for (Index row = before + 1; row < behind; ++row) {
    const double share =
        static_cast<double>(row - before) / static_cast<double>(behind - before);
    values[row] = first + share * (last - first);
  }
}

void fill_column(Eigen::Ref<Vector> values, Eigen::Ref<Vector> marks) {
  Index before = -1;
  for (Index row = 0; row <= values.size(); ++row) {
    const bool end = row == values.size();
    if (!end && std::isnan(values[row])) {
      marks[row] = number_of(Mark::Missing);
      continue;
    }
    if (row - before > 1) fill_between(before, row, values);
    before = row;
  }
}

}  // namespace

FilledTable fill_blanks(Table table, const std::vector<Index>& columns) {
  FilledTable filled{std::move(table), {}};
  Matrix& values = filled.table.values;
  Matrix marks = Matrix::Zero(values.rows(), static_cast<Index>(columns.size()));
  bool any = false;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    auto column = values.col(columns[k]);
    const auto blank = column.array().isNaN();
    if (!blank.any() || blank.all()) continue;
    fill_column(column, marks.col(static_cast<Index>(k)));
    any = true;
  }
  if (any) filled.marks = std::move(marks);
  return filled;
}

}  // namespace lacuna
