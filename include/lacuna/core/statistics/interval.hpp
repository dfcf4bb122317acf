// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace lacuna {

/// The 97.5 % quantile of Student's t distribution: half the width of a 95 % confidence
/// interval in standard errors; 1.96 in the limit. By Boost.Math.
/// @param freedom number of rows minus number of coefficients, at least 1.
/// @throws ArgumentError when it is below 1.
double student_quantile_975(double freedom);

/// The 95 % quantile of the same distribution: half the width of a 90 % band in standard errors.
/// @throws ArgumentError when `freedom` is below 1.
double student_quantile_95(double freedom);

/// The limit of student_quantile_975(), that of the standard normal distribution: a fact.
inline constexpr double kNormalQuantile975 = 1.959963984540054;

/// The 95 % confidence interval of an estimate: estimate -+ quantile x standard error.
/// @param quantile student_quantile_975() where the deviation of the noise was estimated from
/// few residuals.
std::array<double, 2> interval95(double estimate, double standard_error,
                                 double quantile = kNormalQuantile975);

}  // namespace lacuna
