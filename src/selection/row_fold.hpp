// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/types.hpp"
#include "lacuna/linear/factor.hpp"
#include "lacuna/linear/row_pass.hpp"

namespace lacuna {

/// Folds rows [A y] into their triangular factor.
class RowFold {
 public:
  /// @param folding Gram: half the work, resolves problems of moderate condition only.
  RowFold(Index columns, Folding folding);

  /// @param rows one in each column.
  void add(const Eigen::Ref<const Matrix>& rows);

  /// R of all rows so far, columns x columns; nothing when a Gram cannot resolve it: its
  /// relative rounding eps must be small beside the squared share of a column that is new
  /// (condition up to 1e6: 1e-4) and of the target that is not explained (1e-5: 1e-6).
  std::optional<Matrix> triangle();

 private:
  void fold();
  std::optional<Matrix> from_gram() const;

  Folding folding_;
  Index columns_;
  Index capacity_;
  Scratch scratch_;
  Index rows_ = 0;
  Matrix folded_;  // R, or the upper triangle of the padded Gram
};

}  // namespace lacuna
