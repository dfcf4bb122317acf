// SPDX-License-Identifier: MIT
#pragma once

#include "core/numerics/sparse_cholesky.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// The z with least |y - z|^2 + weight sum_i |(D z)_i|.
struct L1Trend {
  Vector values;    ///< z, n
  Index knots = 0;  ///< entries of D z that are not 0
  double gap = 0;   ///< the objective less its lower bound
};

/// By a primal-dual interior-point method (S.-J. Kim et al., SIAM Review 51 (2009) 339-360) on the
/// dual, z = y - D'v with the least v'D D'v - 2 v'D y and |v_i| <= weight / 2: each of some thirty
/// steps is one sparse Cholesky factor of 2 D D' and a diagonal. Every such v gives a lower bound
/// of the objective; steps end where that is within 1e-7 of it, or where rounding decides.
/// @param differences D, k x n, narrow rows, about 1 in size; @param weight > 0.
/// @throws ArgumentError when shapes do not fit.
L1Trend l1_trend(const SparseRows& differences, const Vector& values, double weight);

}  // namespace lacuna
