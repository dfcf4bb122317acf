// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A = U S V' with singular values that fall.
struct SingularValues {
  Vector values;  ///< min(n, L)
  Matrix left;    ///< n x min(n, L): U
  Matrix right;   ///< L x L: V

  /// How many values are larger than `share` of the largest.
  Index rank(double fraction) const;

  /// Orthonormal columns that A maps to nothing: L x (L - rank(share)).
  Matrix null_space(double fraction) const;
};

/// @param a n x L; all numbers are NaN where an entry is not finite.
SingularValues singular_values(const Matrix& a);

}  // namespace lacuna
