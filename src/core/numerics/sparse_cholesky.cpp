// SPDX-License-Identifier: MIT
#include "core/numerics/sparse_cholesky.hpp"

#include <algorithm>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

/// Rows i, columns d: L(i + d, i), the lower band with its diagonal first.
Matrix lower_band(const SparseRows& lower) {
  Index width = 0;
  for (Index i = 0; i < lower.rows(); ++i) {
    const SparseRows::InnerIterator first(lower, i);
    if (first) width = std::max(width, i - first.col());
  }
  Matrix band = Matrix::Zero(width + 1, lower.rows());
  for (Index i = 0; i < lower.rows(); ++i)
    for (SparseRows::InnerIterator entry(lower, i); entry; ++entry)
      band(i - entry.col(), entry.col()) = entry.value();
  return band;
}

}  // namespace

Matrix solve_by_factor(const SparseRows& lower, const Matrix& b) {
  check_argument(lower.rows() == lower.cols() && lower.rows() == b.rows(), "solve_by_factor",
                 "the factor is not square or does not fit the right-hand sides");
  Matrix x = lower.triangularView<Eigen::Lower>().solve(b);
  return lower.transpose().triangularView<Eigen::Upper>().solve(x);
}

Matrix inverse_band(const SparseRows& lower) {
  check_argument(lower.rows() == lower.cols(), "inverse_band", "the factor is not square");
  const Matrix band = lower_band(lower);
  const Index n = band.cols(), width = band.rows() - 1;
  Matrix inverse = Matrix::Zero(width + 1, n);  // Z(j + d, j) at (d, j)
  const auto z = [&](Index i, Index j) { return i >= j ? inverse(i - j, j) : inverse(j - i, i); };
  for (Index j = n - 1; j >= 0; --j) {
    const Index below = std::min(width, n - 1 - j);
    const double pivot = 1.0 / band(0, j);
    for (Index d = below; d >= 0; --d) {
      double sum = d == 0 ? -pivot : 0.0;
      for (Index k = 1; k <= below; ++k) sum += band(k, j) * z(j + d, j + k);
      inverse(d, j) = -pivot * sum;
    }
  }
  return inverse;
}

}  // namespace lacuna
