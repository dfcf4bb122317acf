// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// How rows are folded into statistics.
enum class Folding {
  Automatic,   ///< Gram; tall-skinny QR where the Gram cannot resolve the problem
  Gram,        ///< normal equations and Cholesky: fastest
  Orthogonal,  ///< tall-skinny QR: as accurate as QR of the whole matrix
  Deflated,    ///< Gram of the terms and of what a fit to some rows leaves of the targets
};

/// Of more terms what is sought term by term is sought in the Gram matrix: a fact of cost.
inline constexpr Index kWideTerms = 256;

/// All that is kept of the rows: the triangular factor of [Theta Y] with columns of Theta
/// scaled to unit norm.
///
///   [Theta D^-1, Y] = Q R,  D = diag(column_norms),  R = [R_tt R_ty; 0 R_yy]
///
/// R is (L + m) x (L + m), upper triangular. Any least-squares problem in a subset of the
/// columns has the same solution in R as in the rows, at a cost that does not depend on n.
struct Factor {
  Matrix triangle;      ///< R, (L + m) x (L + m)
  Vector column_norms;  ///< |theta_j|, L; a column of zeros has norm 0 and stays zero
  Vector target_norms;  ///< |y_k|, m
  Index rows = 0;       ///< n
  Folding folding = Folding::Gram;  ///< how it was made
  Matrix gram = {};  ///< [Theta Y]'[Theta Y] of more than kWideTerms terms, where it made R

  Index terms() const noexcept { return column_norms.size(); }  ///< L
};

}  // namespace lacuna
