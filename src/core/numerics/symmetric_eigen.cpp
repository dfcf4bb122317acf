// SPDX-License-Identifier: MIT
#include "core/numerics/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>
#include <limits>

#include "core/base/check.hpp"

namespace lacuna {

SymmetricEigen symmetric_eigen(const Matrix& a) {
  check_argument(a.rows() == a.cols(), "symmetric_eigen", "the matrix is not square");
  const Index n = a.rows();
  if (n == 0) return {Vector(0), Matrix(0, 0)};
  if (a.allFinite()) {
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(a);
    if (solver.info() == Eigen::Success) return {solver.eigenvalues(), solver.eigenvectors()};
  }
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return {Vector::Constant(n, kNan), Matrix::Constant(n, n, kNan)};
}

std::optional<SymmetricEigen> symmetric_eigen(const Matrix& a, const Matrix& b) {
  check_argument(a.rows() == a.cols() && b.rows() == a.rows() && b.cols() == a.cols(),
                 "symmetric_eigen", "the matrices are not square and of one size");
  if (a.rows() == 0) return SymmetricEigen{Vector(0), Matrix(0, 0)};
  if (!a.allFinite() || !b.allFinite()) return std::nullopt;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(a, b);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return SymmetricEigen{solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace lacuna
