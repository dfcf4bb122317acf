// SPDX-License-Identifier: MIT
#include "lacuna/linear/tall_skinny_qr.hpp"

#include <vector>

#include "lacuna/linear/row_pass.hpp"
#include "lacuna/linear/tile_kernels.hpp"

namespace lacuna {
namespace {

Matrix merge(const std::vector<Matrix>& triangles, Index columns) {
  Matrix total = Matrix::Zero(columns, columns);
  Scratch scratch(columns, columns);
  for (const Matrix& triangle : triangles) {
    scratch.block(columns, 0, columns) = triangle;
    fold_triangle(scratch, columns, total);
  }
  return total;
}

void make_diagonal_non_negative(Matrix& triangle) {
  for (Index i = 0; i < triangle.rows(); ++i) {
    if (triangle(i, i) < 0.0) triangle.row(i) = -triangle.row(i);
  }
}

}  // namespace

Matrix fold_orthogonal(const RowSource& rows, const RunContext& context) {
  const Index columns = rows.terms() + rows.targets();
  std::vector<Matrix> slots(row_slots(rows.rows()).size(), Matrix::Zero(columns, columns));
  for_each_tile(rows, context, "reading rows (orthogonal)", [&](Index slot, Tile& tile) {
    fold_triangle(tile.scratch(), tile.rows(), slots[static_cast<std::size_t>(slot)]);
  });
  Matrix total = slots.size() == 1 ? slots.front() : merge(slots, columns);
  make_diagonal_non_negative(total);
  return total;
}

}  // namespace lacuna
