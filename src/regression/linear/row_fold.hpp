// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "regression/linear/row_pass.hpp"

namespace lacuna {

/// Folds rows [A y] into their triangular factor as they come.
class RowFold {
 public:
  /// @param folding Gram: half the work, resolves problems of moderate condition only.
  explicit RowFold(Index columns, Folding folding = Folding::Orthogonal);

  Index columns() const noexcept { return columns_; }

  /// Place for one more row, to be written before the next call; the pointer is to its first
  /// column, columns are stride() apart.
  double* next_row();
  Index stride() const noexcept { return scratch_.stride(); }

  /// @param rows one in each column.
  void add(const Eigen::Ref<const Matrix>& rows);

  /// Rows of an upper triangle, columns x columns.
  void add_triangle(const Eigen::Ref<const Matrix>& triangle);

  /// The rows of another fold of the same kind, which starts anew.
  void merge(RowFold& other);

  /// The Gram matrix of all rows, for a fold by it.
  Matrix gram();

  /// R of all rows, columns x columns; nothing when a Gram cannot resolve it: its relative
  /// rounding eps must be small beside the squared fraction of a column that is new (condition
  /// up to 1e6: 1e-4) and of the target that is not explained (1e-5: 1e-6). Starts anew after
  /// it.
  std::optional<Matrix> finish();

 private:
  void fold();
  std::optional<Matrix> from_gram();

  Folding folding_;
  Index columns_;
  Index capacity_;
  Scratch scratch_;
  Index rows_ = 0;
  Matrix folded_;  // R, or the upper triangle of the padded Gram
};

/// R of [Theta Y] = Q R, (L + m) x (L + m), upper triangular with non-negative diagonal, by
/// Householder reflections tile by tile: as accurate as the QR of the whole matrix. One pass
/// over the rows. (Demmel, Grigori, Hoemmen, Langou 2012, sequential TSQR.)
Matrix fold_orthogonal(const RowSource& rows, const RunContext& context = {});

}  // namespace lacuna
