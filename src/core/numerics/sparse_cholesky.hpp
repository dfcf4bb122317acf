// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>
#include <string>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A sparse matrix whose rows are read one after the other.
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

/// Factor L of a sparse symmetric positive definite C = L L', n x n, its rows in the order in
/// which they are: a band stays a band. By CHOLMOD's simplicial factorisation (Chen et al., ACM
/// TOMS 35, 2008), or by Eigen's where lacuna was built without it.
/// @param matrix both triangles of C. @throws ArgumentError where C is not positive definite.
SparseRows sparse_cholesky(const SparseRows& matrix);

/// What sparse_cholesky() is computed by: "CHOLMOD" or "Eigen".
std::string sparse_cholesky_back_end();

/// X of L L' X = B. @param b n x K. @throws ArgumentError when shapes do not fit.
Matrix solve_by_factor(const SparseRows& lower, const Matrix& b);

/// Entries of Z = (L L')^-1 inside the lower band of L: entry (d, j) is Z_(j+d, j). From the last
/// column up (Erisman & Tinney, Comm. ACM 18 (1975) 177-179):
///   Z_ij = -(1 / L_jj) sum_(k>j) L_kj Z_ik,   Z_jj = 1 / L_jj^2 - (1 / L_jj) sum_(k>j) L_kj Z_kj.
/// @throws ArgumentError when L is not square.
Matrix inverse_band(const SparseRows& lower);

}  // namespace lacuna
