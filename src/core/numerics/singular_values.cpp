// SPDX-License-Identifier: MIT
#include "lacuna/core/numerics/singular_values.hpp"

#include <Eigen/SVD>

namespace lacuna {

Index SingularValues::rank(double share) const {
  return values.size() == 0 ? 0 : (values.array() > share * values[0]).count();
}

Matrix SingularValues::null_space(double share) const {
  return right.rightCols(right.cols() - rank(share));
}

SingularValues singular_values(const Matrix& a) {
  if (a.rows() == 0) return {Vector(0), Matrix(0, 0), Matrix::Identity(a.cols(), a.cols())};
  const Eigen::BDCSVD<Matrix> found(a, Eigen::ComputeThinU | Eigen::ComputeFullV);
  return {found.singularValues(), found.matrixU(), found.matrixV()};
}

}  // namespace lacuna
