// SPDX-License-Identifier: MIT
// Whether the residual of a model comes again with the value of a variable: teeth, poles, a
// grating along the way.
#pragma once

#include <optional>

#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// A period in the value of a variable.
struct ValuePeriod {
  double longest = 0.0;   ///< fundamental, unit of the variable
  double shortest = 0.0;  ///< what steps of the path still resolve
  Index tried = 0;        ///< number of periods among which the fundamental is the best
};

/// The fundamental d(x) = a sin(2 pi x/L) + b cos(2 pi x/L) + c that follows the smoothed
/// disturbance of an equation best over the values x of a variable: the largest peak of the
/// least-squares periodogram (Lomb, Astrophysics and Space Science 39 (1976)) from two periods
/// within the range to four steps (rms) a period.
/// @param slot number of the variable: states, then inputs.
/// @return nothing where the range has no room for such periods.
std::optional<ValuePeriod> best_period(const Assimilation& fit, Index equation, Index slot);

}  // namespace lacuna
