// SPDX-License-Identifier: MIT
#include "regression/linear/row_fold.hpp"

#include <algorithm>
#include <vector>

#include "core/base/parts.hpp"
#include "regression/linear/gram.hpp"
#include "regression/linear/tile_kernels.hpp"
#include "regression/linear/triangular.hpp"

namespace lacuna {
namespace {

constexpr double kCondition = 1e6;
constexpr double kResidual = 1e-5;

// A Gram is fastest when a tile stays in the cache, a triangle when few tiles pass through it.
constexpr Index kGramRows = 64;
constexpr Index kTriangleRows = 256;

Matrix merge(const std::vector<Matrix>& triangles, Index columns) {
  RowFold total(columns);
  for (const Matrix& triangle : triangles) total.add_triangle(triangle);
  return *total.finish();
}

void make_diagonal_non_negative(Matrix& triangle) {
  for (Index i = 0; i < triangle.rows(); ++i) {
    if (triangle(i, i) < 0.0) triangle.row(i) = -triangle.row(i);
  }
}

}  // namespace

RowFold::RowFold(Index columns, Folding folding)
    : folding_(folding),
      columns_(columns),
      capacity_(folding == Folding::Gram
                    ? kGramRows
                    : Scratch::padded_rows(std::max(kTriangleRows, columns))),
      scratch_(capacity_, columns) {
  const Index size = folding == Folding::Gram ? scratch_.padded_columns() : columns;
  folded_.resize(size, size);
  folded_.setZero();
}

double* RowFold::next_row() {
  if (rows_ == capacity_) fold();
  return scratch_.data() + rows_++;
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

void RowFold::add_triangle(const Eigen::Ref<const Matrix>& triangle) {
  if (folding_ == Folding::Gram)
    return add(Matrix(triangle.triangularView<Eigen::Upper>()).transpose());
  fold();
  scratch_.block(columns_, 0, columns_) = triangle.triangularView<Eigen::Upper>();
  rows_ = columns_;
  fold();
}

void RowFold::merge(RowFold& other) {
  other.fold();
  if (folding_ == Folding::Gram)
    folded_ += other.folded_;
  else
    add_triangle(other.folded_);
  other.folded_.setZero();
}

void RowFold::fold() {
  if (rows_ == 0) return;
  const Index all = Scratch::padded_rows(rows_);
  scratch_.block(all, 0, columns_).bottomRows(all - rows_).setZero();
  if (folding_ == Folding::Gram)
    add_gram(scratch_, rows_, folded_);
  else
    fold_triangle(scratch_, rows_, folded_);
  rows_ = 0;
}

std::optional<Matrix> RowFold::finish() {
  fold();
  std::optional<Matrix> triangle = folding_ == Folding::Gram ? from_gram() : folded_;
  folded_.setZero();
  return triangle;
}

Matrix RowFold::gram() {
  fold();
  return folded_.topLeftCorner(columns_, columns_).selfadjointView<Eigen::Upper>();
}

std::optional<Matrix> RowFold::from_gram() {
  const Matrix gram = this->gram();
  if (!gram.allFinite()) return std::nullopt;
  const Index last = columns_ - 1;
  GramFactor factor = factor_gram(gram, last);
  const bool resolved =
      !factor.broke_down && factor.triangle(last, last) > kResidual &&
      condition_estimate(factor.triangle.topLeftCorner(last, last)) < kCondition;
  if (!resolved) return std::nullopt;
  return factor.triangle * gram.diagonal().cwiseSqrt().asDiagonal();
}

Matrix fold_orthogonal(const RowSource& rows, const RunContext& context) {
  const Index columns = rows.terms() + rows.targets();
  std::vector<Matrix> slots(row_slots(rows.rows()).size(), Matrix::Zero(columns, columns));
  for_each_tile(rows, context, "reading rows (orthogonal)", [&](Index slot, Tile& tile) {
    fold_triangle(tile.scratch(), tile.rows(), slots[static_cast<std::size_t>(slot)]);
  });
  exchange_parts(slots.size(), context,
                 [&](std::size_t slot) { return numbers_of(slots[slot]); });
  Matrix total = slots.size() == 1 ? slots.front() : merge(slots, columns);
  make_diagonal_non_negative(total);
  return total;
}

}  // namespace lacuna
