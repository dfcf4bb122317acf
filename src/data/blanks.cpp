// SPDX-License-Identifier: MIT
#include "blanks.hpp"

#include <cmath>
#include <utility>

#include "lacuna/data/marks.hpp"

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

}  // namespace lacuna
