// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <cstdint>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// A noise-free record of a model: n samples at t = 0, h, 2h, ... from x0, one trajectory, with
/// dx/dt of the model at the samples.
/// @throws ArgumentError when the orbit diverges (the message says where) and as simulate().
Dataset record_of(const OdeModel& model, const Integrator& integrator, const Vector& x0,
                  double h, Index n);

/// The record with white Gaussian noise of standard deviation sigma_i (unit of the state) added
/// to each state. Derivatives that came with the record are dropped: they are not measured.
/// @throws ArgumentError when sigma does not have one entry >= 0 per state.
/// @throws ArgumentError unless there is one finite sigma >= 0 per state; the same below.
Dataset add_noise(const Dataset& record, const Vector& sigma, std::uint64_t seed);

/// The same relative noise on all states: sigma_i = share times the standard deviation of state
/// i.
Dataset add_relative_noise(const Dataset& record, double fraction, std::uint64_t seed);

/// The states as an analogue-digital converter gives them: the nearest of 2^bits levels
/// k 2 range / 2^bits, k = -2^(bits-1) .. 2^(bits-1) - 1, clipped at the ends.
/// Derivatives that came with the record are dropped.
/// @throws ArgumentError when bits is not in 1..32 or range is not positive.
Dataset quantise(const Dataset& record, int bits, double range);

}  // namespace lacuna
