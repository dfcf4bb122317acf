// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A V = B V diag(values) with values that rise and V'B V = I.
struct SymmetricEigen {
  Vector values;   ///< n
  Matrix vectors;  ///< n x n, in columns
};

/// Of a symmetric matrix, B = I; the lower triangle is read. NaN where an entry is not finite
/// or the iteration does not converge.
/// @throws ArgumentError when the matrix is not square.
SymmetricEigen symmetric_eigen(const Matrix& a);

/// Of a symmetric matrix and one that is positive definite; nothing where it is not, where an
/// entry is not finite, or where the iteration does not converge.
/// @throws ArgumentError unless both are square and of one size.
std::optional<SymmetricEigen> symmetric_eigen(const Matrix& a, const Matrix& b);

}  // namespace lacuna
