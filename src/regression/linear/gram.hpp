// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// [Theta Y]' [Theta Y], (L + m) x (L + m), both triangles filled. One pass over the rows.
Matrix fold_gram(const RowSource& rows, const RunContext& context = {});

/// The same of [Theta, Y - Theta H]: what coefficients H leave of the targets.
/// @param h L x m.
/// @throws ArgumentError when H does not fit.
Matrix fold_deflated_gram(const RowSource& rows, const Matrix& h,
                          const RunContext& context = {});

/// A Cholesky factor and whether it can be trusted.
struct GramFactor {
  Matrix triangle;          ///< R, upper triangular with non-negative diagonal
  bool broke_down = false;  ///< a pivot among the first `terms` columns was lost to rounding
};

/// Cholesky factor R'R = D^-1 G D^-1 of a Gram matrix scaled to unit diagonal, D = sqrt(diag
/// G). Columns that depend on earlier ones, and columns of zeros, get a row of zeros in R.
/// @param terms columns that are looked at for a breakdown; columns of zeros do not count.
/// @param context asked between columns whether to stop
/// @throws ArgumentError when the matrix is not square.
GramFactor factor_gram(const Matrix& gram, Index terms, const RunContext& context = {});

}  // namespace lacuna
