// SPDX-License-Identifier: MIT
#include "core/numerics/singular_values.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <limits>

namespace lacuna {

Index SingularValues::rank(double fraction) const {
  return values.size() == 0 ? 0 : (values.array() > fraction * values[0]).count();
}

Matrix SingularValues::null_space(double fraction) const {
  return right.rightCols(right.cols() - rank(fraction));
}

SingularValues singular_values(const Matrix& a) {
  const Index n = a.rows(), l = a.cols(), least = std::min(n, l);
  if (least == 0) return {Vector(0), Matrix(n, 0), Matrix::Identity(l, l)};
  if (!a.allFinite()) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    return {Vector::Constant(least, kNan), Matrix::Constant(n, least, kNan),
            Matrix::Constant(l, l, kNan)};
  }
  const Eigen::BDCSVD<Matrix> found(a, Eigen::ComputeThinU | Eigen::ComputeFullV);
  return {found.singularValues(), found.matrixU(), found.matrixV()};
}

}  // namespace lacuna
