// SPDX-License-Identifier: MIT
#include "lacuna/core/numerics/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace lacuna {

SymmetricEigen symmetric_eigen(const Matrix& a) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

std::optional<SymmetricEigen> symmetric_eigen(const Matrix& a, const Matrix& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(a, b);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return SymmetricEigen{solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace lacuna
