// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// A model that was estimated from the numbers of a system, in the parameters and formulas of
/// that system. Each term of `given.model()` has an estimated and a given coefficient, and
/// their ratio stands as a number in front of what was written:
///
///   di/dt = (u - R i)/L,  1/L = 10 -> 10.2,  R/L = 5 -> 5   gives   1.02 u/L - R i/L
///
/// A summand whose terms all have one ratio (1 is left out) stays as it was written, others are
/// multiplied out. Terms and states that the system does not have are added as they are; an
/// equation that cannot be written so that model() gives its estimated coefficients back to
/// rounding is the estimated one, in numbers. Errors and intervals become those of the ratio.
/// @param estimated `given.model()` with other coefficients, more terms and, behind its own,
///   more states; a state that is called as a parameter makes the answer one in numbers.
SystemModel with_parameters_of(const SystemModel& given, const OdeModel& estimated);

}  // namespace lacuna
