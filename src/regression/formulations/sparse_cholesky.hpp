// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "regression/formulations/projection.hpp"

namespace lacuna {

/// Factor L of a sparse symmetric positive definite C = L L', n x n, its rows in the order in
/// which they are: a band stays a band. By CHOLMOD's simplicial factorisation (Chen et al., ACM
/// TOMS 35, 2008), or by Eigen's where lacuna was built without it.
/// @param matrix both triangles of C. @throws ArgumentError where C is not positive definite.
SparseRows sparse_cholesky(const SparseRows& matrix);

/// What sparse_cholesky() is computed by: "CHOLMOD" or "Eigen".
std::string sparse_cholesky_back_end();

}  // namespace lacuna
