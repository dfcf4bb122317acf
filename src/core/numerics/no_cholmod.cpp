// SPDX-License-Identifier: MIT
// Eigen's factorisation, where lacuna is built without SuiteSparse.
#include <Eigen/SparseCholesky>

#include "lacuna/core/base/error.hpp"
#include "core/numerics/sparse_cholesky.hpp"

namespace lacuna {

SparseRows sparse_cholesky(const SparseRows& matrix) {
  using Columns = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;
  const Eigen::SimplicialLLT<Columns, Eigen::Lower, Eigen::NaturalOrdering<Index>> factor{
      Columns(matrix)};
  if (factor.info() != Eigen::Success)
    throw ArgumentError("sparse_cholesky", "the matrix is not positive definite",
                        "leave out rows that depend on each other");
  return SparseRows(factor.matrixL());
}

std::string sparse_cholesky_back_end() { return "Eigen"; }

}  // namespace lacuna
