// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// H of min |A H - B|, column by column, by a QR decomposition with column pivoting: columns of
/// A that depend on others to rounding get 0.
/// @param a n x L. @param b n x K. @return L x K.
Matrix least_squares(const Matrix& a, const Matrix& b);

/// X of A X = B, A symmetric and positive semidefinite, by L D L' with pivoting.
Matrix solve_symmetric(const Matrix& a, const Matrix& b);

/// The smallest of all H of min |A H - B|, by a complete orthogonal decomposition.
Matrix smallest_least_squares(const Matrix& a, const Matrix& b);

}  // namespace lacuna
