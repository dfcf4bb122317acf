// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// H of min |A H - B|, column by column, by a QR decomposition with column pivoting: columns of
/// A that depend on others to rounding get 0. NaN where an entry of A or B is not finite.
/// @param a n x L. @param b n x K. @return L x K; zeros where n is 0.
/// @throws ArgumentError when A and B differ in rows.
Matrix least_squares(const Matrix& a, const Matrix& b);

/// X of A X = B, A symmetric and positive semidefinite, by L D L' with pivoting. NaN where an
/// entry of A or B is not finite.
/// @throws ArgumentError when A is not square or B has another number of rows.
Matrix solve_symmetric(const Matrix& a, const Matrix& b);

/// The smallest of all H of min |A H - B|, by a complete orthogonal decomposition. Shapes, NaN
/// and errors as those of least_squares().
Matrix smallest_least_squares(const Matrix& a, const Matrix& b);

}  // namespace lacuna
