// SPDX-License-Identifier: MIT
#include "regression/linear/gram.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/parts.hpp"
#include "regression/linear/row_pass.hpp"
#include "regression/linear/tile_kernels.hpp"

namespace lacuna {
namespace {

Matrix symmetric(const Matrix& upper) { return upper.selfadjointView<Eigen::Upper>(); }

Matrix unit_diagonal(const Matrix& gram) {
  const Vector scale = gram.diagonal().unaryExpr(
      [](double square) { return square > 0.0 ? 1.0 / std::sqrt(square) : 0.0; });
  return scale.asDiagonal() * gram * scale.asDiagonal();
}

/// The Gram matrix of rows that `prepare` may change tile by tile.
Matrix fold_prepared(const RowSource& rows, const RunContext& context,
                     FunctionRef<void(Tile& tile)> prepare) {
  const Index columns = rows.terms() + rows.targets();
  const Index padded = Scratch(1, columns).padded_columns();
  std::vector<Matrix> slots(row_slots(rows.rows()).size(), Matrix::Zero(padded, padded));
  for_each_tile(rows, context, "reading rows", [&](Index slot, Tile& tile) {
    prepare(tile);
    add_gram(tile.scratch(), tile.rows(), slots[static_cast<std::size_t>(slot)]);
  });
  exchange_parts(slots.size(), context,
                 [&](std::size_t slot) { return numbers_of(slots[slot]); });
  Matrix total = Matrix::Zero(padded, padded);
  for (const Matrix& slot : slots) total += slot;
  return symmetric(total.topLeftCorner(columns, columns));
}

}  // namespace

Matrix fold_gram(const RowSource& rows, const RunContext& context) {
  return fold_prepared(rows, context, [](Tile&) {});
}

Matrix fold_deflated_gram(const RowSource& rows, const Matrix& h, const RunContext& context) {
  check_argument(h.rows() == rows.terms() && h.cols() == rows.targets(), "fold_deflated_gram",
                 "the coefficients do not fit the rows", "give one for each term and target");
  return fold_prepared(rows, context,
                       [&](Tile& tile) { deflate_targets(tile.scratch(), tile.rows(), h); });
}

GramFactor factor_gram(const Matrix& gram, Index terms, const RunContext& context) {
  check_argument(gram.rows() == gram.cols(), "factor_gram", "the Gram matrix is not square");
  const Index columns = gram.cols();
  const double tolerance =
      4.0 * static_cast<double>(columns) * std::numeric_limits<double>::epsilon();
  GramFactor factor{unit_diagonal(gram).triangularView<Eigen::Upper>(), false};
  Matrix& r = factor.triangle;
  for (Index j = 0; j < columns; ++j) {
    context.check_stop();
    const bool zero = r(j, j) == 0.0;
    for (Index i = 0; i < j; ++i) {
      const double rest = r(i, j) - r.col(i).head(i).dot(r.col(j).head(i));
      r(i, j) = r(i, i) > 0.0 ? rest / r(i, i) : 0.0;
    }
    const double pivot = r(j, j) - r.col(j).head(j).squaredNorm();
    r(j, j) = pivot > tolerance ? std::sqrt(pivot) : 0.0;
    factor.broke_down |= j < terms && !zero && r(j, j) == 0.0;
  }
  return factor;
}

}  // namespace lacuna
