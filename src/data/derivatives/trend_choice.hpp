// SPDX-License-Identifier: MIT
#pragma once

#include "core/numerics/sparse_cholesky.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Differences of samples in units of their mean step, so that they are about 1 in size whatever
/// the unit of time.
struct ScaledDifferences {
  double step = 1.0;  ///< mean, time
  SparseRows rows;    ///< n - d x n: divided_differences() of t / step
};

/// @throws ArgumentError as divided_differences().
ScaledDifferences scaled_differences(const Vector& time, int order);

/// A weight of l1_trend() in units of the noise.
struct TrendChoice {
  double weight = 0.0;  ///< penalty of a difference of 1, in standard deviations of the noise
  double score = 0.0;   ///< C_p of all columns
};

/// The largest of weights, from what joins no samples to what joins all of them, that is as good
/// as the best by Mallows' C_p = RSS / sigma^2 + 2 (knots + d), summed over columns (degrees of
/// freedom: R. J. Tibshirani & J. Taylor, Ann. Stat. 40 (2012) 1198-1232). A knot more that noise
/// alone asks for changes C_p by 1 +- sqrt(2), so that the best is as often one of too many knots.
/// @param values n x m; @param noise m standard deviations; columns without noise do not count.
TrendChoice choose_trend(const SparseRows& differences, const Matrix& values,
                         const Vector& noise);

/// How many samples a weight joins: residuals of so many balance the penalty of a difference of
/// this order.
double joined_samples(double weight, int order);

}  // namespace lacuna
