// SPDX-License-Identifier: MIT
#include "gathered_rows.hpp"

#include "core/numerics/qr.hpp"

namespace lacuna {

/// A system gives out residuals only: y is that of no term, and y - c theta_j that of one, with
/// c of a size at which nothing cancels.
Matrix gathered_rows(const LeastSquaresSystem& system, Index target, const TermSet& active,
                     const RunContext& context) {
  const auto terms = static_cast<Index>(active.size());
  Matrix rows(system.rows(), terms + 1);
  rows.col(terms) = system.residuals(target, {}, Vector(), context);
  const double size = system.factor().target_norms[target];
  for (Index j = 0; j < terms; ++j) {
    const Index term = active[static_cast<std::size_t>(j)];
    const double norm = system.factor().column_norms[term];
    const double c = size > 0.0 && norm > 0.0 ? size / norm : 1.0;
    const Vector rest = system.residuals(target, {term}, Vector::Constant(1, c), context);
    rows.col(j) = (rows.col(terms) - rest) / c;
  }
  return rows;
}

Matrix row_triangle(const Eigen::Ref<const Matrix>& rows) {
  if (rows.rows() <= rows.cols()) return rows;
  return Qr(rows).triangle();
}

Factor factor_of_rows(Matrix rows, Index count) {
  const Index terms = rows.cols() - 1;
  Factor factor;
  factor.rows = count;
  factor.column_norms = rows.leftCols(terms).colwise().norm();
  factor.target_norms = Vector::Constant(1, rows.col(terms).norm());
  for (Index j = 0; j < terms; ++j)
    if (factor.column_norms[j] > 0.0) rows.col(j) /= factor.column_norms[j];
  factor.triangle = Matrix::Zero(terms + 1, terms + 1);
  const Matrix triangle = row_triangle(rows);
  factor.triangle.topRows(triangle.rows()) = triangle;
  return factor;
}

}  // namespace lacuna
