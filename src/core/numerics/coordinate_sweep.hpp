// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Penalties of coefficients z: sum_j first_j |z_j| + second / 2 |z|^2.
struct SweepPenalty {
  const Vector& first;  ///< k
  double second = 0.0;
};

/// One pass of coordinate descent over |c - R z|^2 + penalty: each coefficient at its minimum
/// beside the others as they are, one after the other; 0 where its column is. Friedman et al.,
/// Ann. Appl. Statist. 1 (2007) 302, eq. (9).
/// @param gram R'R, k x k. @param slope R'(c - R z), which is kept up to date.
/// @return the largest change.
double coordinate_sweep(const Matrix& gram, const SweepPenalty& penalty, Vector& z,
                        Vector& slope);

}  // namespace lacuna
