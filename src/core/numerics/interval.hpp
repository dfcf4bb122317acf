// SPDX-License-Identifier: MIT
#pragma once

namespace lacuna {

/// The 97.5 % quantile of Student's t distribution: half the width of a 95 % confidence
/// interval in standard errors; 1.96 in the limit. By Boost.Math.
/// @param freedom number of rows minus number of coefficients, at least 1.
/// @throws ArgumentError when it is below 1.
double student_quantile_975(double freedom);

}  // namespace lacuna
