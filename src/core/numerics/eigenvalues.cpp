// SPDX-License-Identifier: MIT
#include "core/numerics/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

#include "core/base/check.hpp"

namespace lacuna {

std::vector<std::complex<double>> eigenvalues(const Matrix& a) {
  check_argument(a.rows() == a.cols(), "eigenvalues", "the matrix is not square");
  if (a.rows() == 0 || !a.allFinite()) return {};
  const Eigen::EigenSolver<Matrix> solver(a, false);
  if (solver.info() != Eigen::Success) return {};
  return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
}

}  // namespace lacuna
