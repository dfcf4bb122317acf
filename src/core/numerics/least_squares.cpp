// SPDX-License-Identifier: MIT
#include "lacuna/core/numerics/least_squares.hpp"

#include <Eigen/Cholesky>

#include "lacuna/core/numerics/qr.hpp"

namespace lacuna {

namespace {

/// One column is solved as a vector: what can be exact, as a fixed coefficient, is.
template <class Decomposition>
Matrix solved(const Decomposition& decomposition, const Matrix& b) {
  if (b.cols() == 1) return Vector(decomposition.solve(Vector(b.col(0))));
  return decomposition.solve(b);
}

}  // namespace

Matrix least_squares(const Matrix& a, const Matrix& b) { return solved(PivotedQr(a), b); }

Matrix solve_symmetric(const Matrix& a, const Matrix& b) {
  return Eigen::LDLT<Matrix>(a).solve(b);
}

Matrix smallest_least_squares(const Matrix& a, const Matrix& b) {
  return solved(a.completeOrthogonalDecomposition(), b);
}

}  // namespace lacuna
