// SPDX-License-Identifier: MIT
#pragma once

#include "core/numerics/sparse_cholesky.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// n - d x n: the d-th derivatives of the polynomials through d + 1 neighbouring samples, d!
/// times the divided differences. @throws ArgumentError when there are not more times than d.
SparseRows divided_differences(const Vector& time, int order);

/// k-th derivatives of smoothed samples by differences of fourth order on any grid; k = 0 gives
/// them as they are. @throws DataError for fewer than 4 + k samples.
Matrix smooth_differences(const Vector& time, const Matrix& values, int order);

}  // namespace lacuna
