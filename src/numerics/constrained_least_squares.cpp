// SPDX-License-Identifier: MIT
#include "lacuna/numerics/constrained_least_squares.hpp"

#include <Eigen/QR>

#include "lacuna/core/error.hpp"
#include "lacuna/numerics/least_squares.hpp"

namespace lacuna {
namespace {

/// Share of the largest pivot below which a direction is none.
constexpr double kRank = 1e-12;

Eigen::ColPivHouseholderQR<Matrix> factor_of(const Matrix& matrix) {
  Eigen::ColPivHouseholderQR<Matrix> factor;
  factor.setThreshold(kRank);
  factor.compute(matrix);
  return factor;
}

}  // namespace

ConstrainedSolution constrained_least_squares(const Matrix& r, const Vector& c, const Matrix& a,
                                              const Vector& b) {
  if (r.cols() != a.cols() || r.rows() != c.size() || a.rows() != b.size())
    throw ArgumentError("constrained least squares", "the shapes do not fit",
                        "give one row of A for each entry of b, one column for each unknown");
  // Columns of unit length, so that pivots can be compared.
  Vector scale = r.colwise().norm();
  for (double& norm : scale) norm = norm > 0.0 ? 1.0 / norm : 1.0;
  const Matrix rs = r * scale.asDiagonal(), as = a * scale.asDiagonal();
  const Index q = r.cols();
  const auto factor = factor_of(as.transpose());
  const Index rank = factor.rank();
  const Matrix basis = factor.householderQ() * Matrix::Identity(q, q);
  const Matrix null = basis.rightCols(q - rank);
  const Vector particular = smallest_least_squares(as, b);
  ConstrainedSolution solution{particular, Vector::Zero(q)};
  if (null.cols() > 0) {
    const auto free = factor_of(rs * null);
    solution.h += null * free.solve(c - rs * particular);
    const Index k = null.cols();
    const Matrix upper = free.matrixR().topLeftCorner(k, k);
    const Matrix inverse =
        upper.triangularView<Eigen::Upper>().solve(Matrix(Matrix::Identity(k, k)));
    const Matrix spread = null * (free.colsPermutation() * inverse);
    solution.variances = spread.rowwise().squaredNorm();
  }
  solution.h = solution.h.cwiseProduct(scale);
  solution.variances = solution.variances.cwiseProduct(scale.cwiseAbs2());
  return solution;
}

bool is_feasible(const Matrix& a, const Vector& b) {
  if (a.rows() == 0) return true;
  const Vector h = smallest_least_squares(a, b);
  constexpr double kRounding = 1e-9;
  return (a * h - b).norm() <= kRounding * std::max(1e-300, b.norm());
}

}  // namespace lacuna
