// SPDX-License-Identifier: MIT
#include "lacuna/numerics/least_squares.hpp"

#include <Eigen/QR>

namespace lacuna {

Matrix least_squares(const Matrix& a, const Matrix& b) {
  return a.colPivHouseholderQr().solve(b);
}

Matrix smallest_least_squares(const Matrix& a, const Matrix& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

}  // namespace lacuna
