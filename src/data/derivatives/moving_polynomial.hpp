// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A signal and its rate from polynomials of degree 4 that are fitted in moving windows, on any
/// grid. The window is the one of 5, 7, 9, 13, ... samples with the least estimated risk
///   sum_i (r_i / sigma_i)^2 + 2 trace(S)   (Mallows' C_p; S takes the samples to the fit),
/// which balances noise against the bending that a polynomial cannot follow.
/// @param noise sigma of the samples, one for all or one for each; 0 gives the narrowest
/// window.
/// @return n x 2: the signal, its rate. Fewer than five samples are interpolated.
/// @throws ArgumentError when shapes do not fit, there is no sample or the times do not
///   increase.
Matrix smooth_by_polynomials(const Vector& time, const Vector& values, double noise);
Matrix smooth_by_polynomials(const Vector& time, const Vector& values, const Vector& noise);

}  // namespace lacuna
