// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Hellinger's distance of the invariant densities of two attractors, from histograms in all m
/// states together: sqrt(1 - sum_c sqrt(p_c q_c)) over the cells c, 0 for equal and 1 for
/// attractors that share no cell. The edges of the cells are 3.49 s_k n^(-1/(m+2)), s_k the
/// standard deviation of state k over both records, n the samples of the shorter one (Scott,
/// Multivariate Density Estimation, 1992, Sect. 3.4). Samples that repeat orbits of another
/// length have a distance of a few per cent by chance alone; compare it with that of two orbits
/// of one system.
/// @param a, b samples x m. @throws ArgumentError when states differ, a record is empty, or a
///   sample or its square is not finite.
double density_distance(const Matrix& a, const Matrix& b);

}  // namespace lacuna
