// SPDX-License-Identifier: MIT
#pragma once

namespace lacuna {

/// The 97.5 % quantile of Student's t distribution: half the width of a 95 % confidence
/// interval in standard errors. Exact for 1 and 2 degrees of freedom, else within 1 % by the
/// expansion in 1/freedom of Abramowitz & Stegun, 26.7.5; 1.96 in the limit.
/// @param freedom number of rows minus number of coefficients, at least 1.
/// @throws ArgumentError when it is below 1.
double student_quantile_975(double freedom);

}  // namespace lacuna
