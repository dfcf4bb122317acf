// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Median absolute value of a standard normal variable: a fact, the quantile 0.75.
inline constexpr double kNormalMedian = 0.674489750196082;

/// A scale of differences of order k + 1 that is not below this fraction of that of order k has
/// levelled off: it is the noise, and no longer the signal, which falls by more
/// (docs/decisions.md).
inline constexpr double kLevelledOff = 0.93;

/// The value of rank floor(fraction (n - 1)) among n values, from 0. No value is interpolated.
/// @throws ArgumentError when there is no value, or the fraction is not from 0 to 1.
double quantile(std::vector<double>& values, double fraction);

/// The mean of the two middle values of an even number of them.
/// @throws ArgumentError when there is no value; the same below.
double median(std::vector<double> values);

/// The value of rank floor(n / 2): one of the values, at half the cost of median(). For scales
/// of many values, where the two differ by less than either is known.
double upper_median(std::vector<double> values);

/// The absolute values.
std::vector<double> magnitudes(const Eigen::Ref<const Vector>& values);

/// upper_median() of magnitudes, none of which is below 0: where they are many at a third of
/// its cost.
double median_size(std::vector<double> sizes);

/// Deviation of normal noise by the magnitudes of its values: median_size() / kNormalMedian.
/// Half of the values may be anything.
double normal_deviation(std::vector<double> sizes);

}  // namespace lacuna
