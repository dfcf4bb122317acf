// SPDX-License-Identifier: MIT
#include "row_fold.hpp"

#include <algorithm>

#include "lacuna/linear/gram.hpp"
#include "lacuna/linear/tile_kernels.hpp"
#include "lacuna/linear/triangular.hpp"

namespace lacuna {
namespace {

constexpr double kCondition = 1e6;
constexpr double kResidual = 1e-5;

// A Gram is fastest when a tile stays in the cache, a triangle when few tiles pass through it.
constexpr Index kGramRows = 64;
constexpr Index kTriangleRows = 256;

Index padded(Index rows) {
  return (rows + Scratch::kRowPadding - 1) / Scratch::kRowPadding * Scratch::kRowPadding;
}

}  // namespace

RowFold::RowFold(Index columns, Folding folding)
    : folding_(folding),
      columns_(columns),
      capacity_(folding == Folding::Gram ? kGramRows
                                         : padded(std::max(kTriangleRows, columns))),
      scratch_(capacity_, columns) {
  const Index size = folding == Folding::Gram ? scratch_.padded_columns() : columns;
  folded_.setZero(size, size);
}

void RowFold::add(const Eigen::Ref<const Matrix>& rows) {
  for (Index done = 0; done < rows.cols();) {
    if (rows_ == capacity_) fold();
    const Index count = std::min(capacity_ - rows_, rows.cols() - done);
    scratch_.block(rows_ + count, 0, columns_).bottomRows(count) =
        rows.middleCols(done, count).transpose();
    rows_ += count;
    done += count;
  }
}

void RowFold::fold() {
  if (rows_ == 0) return;
  const Index all = padded(rows_);
  scratch_.block(all, 0, columns_).bottomRows(all - rows_).setZero();
  if (folding_ == Folding::Gram)
    add_gram(scratch_, rows_, folded_);
  else
    fold_triangle(scratch_, rows_, folded_);
  rows_ = 0;
}

std::optional<Matrix> RowFold::triangle() {
  fold();
  return folding_ == Folding::Gram ? from_gram() : folded_;
}

std::optional<Matrix> RowFold::from_gram() const {
  const Matrix gram = folded_.topLeftCorner(columns_, columns_).selfadjointView<Eigen::Upper>();
  if (!gram.allFinite()) return std::nullopt;
  const Index last = columns_ - 1;
  GramFactor factor = factor_gram(gram, last);
  const bool resolved =
      !factor.broke_down && factor.triangle(last, last) > kResidual &&
      condition_estimate(factor.triangle.topLeftCorner(last, last)) < kCondition;
  if (!resolved) return std::nullopt;
  return factor.triangle * gram.diagonal().cwiseSqrt().asDiagonal();
}

}  // namespace lacuna
