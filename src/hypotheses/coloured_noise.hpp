// SPDX-License-Identifier: MIT
// The explanation by the measurement: noise that has a memory.
#pragma once

#include "lacuna/estimation/assimilation.hpp"

namespace lacuna {

/// The noise model with an Ornstein-Uhlenbeck process on each channel: correlation times from
/// a grid, the same for all channels first, then each by itself; deviations are those of the
/// largest likelihood on the linearisation as it is.
NoiseModel with_coloured_noise(const Assimilation& fit, const RunContext& context);

/// The channels whose noise has a memory worth telling of (a tenth of the white part or more),
/// with its standard deviation and correlation time: "v 0.15 m/s over 4 s".
std::string channels_with_memory(const NoiseModel& noise, const OdeModel& model);

}  // namespace lacuna
