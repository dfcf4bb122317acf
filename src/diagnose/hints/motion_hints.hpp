// SPDX-License-Identifier: MIT
#pragma once

#include "diagnose/hints/hints.hpp"
#include "window_rates.hpp"

namespace lacuna {

/// Steps in a mean period of samples x of a state: pi / asin(rms(x_{i+1} - x_i) / (2 s)) with
/// the standard deviation s of x, both without noise; exact for a sine.
/// @param sigma of the noise, 0 where none is known.
double steps_in_period(const Dataset& data, Index state, double sigma);

/// What the motion lets a diagnosis say: inputs that follow the states (closed loop), states
/// that hardly move and inputs that do not at all (excitation), periods with few samples and
/// records with few periods (sampling), terms of an equation that go along (not identifiable).
std::vector<Hint> motion_hints(const OdeModel& model, const BoundRecords& records,
                               const RateWindows& windows, const HintOptions& options);

}  // namespace lacuna
