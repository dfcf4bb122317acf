// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hidden/support/benches.hpp"

namespace lacuna::hidden {

/// What makes a wrong name likely on a bench. The list was written before anything that they
/// test was changed.
enum class Bench {
  LateMotor,      ///< a motor behind a converter: its voltage acts part of a step late
  LateFilter,     ///< a filter of order 2 driven by two levels that act 1.2 to 2.8 steps late
  NoisyTorque,    ///< nothing is missing, and the torque is measured with 1 to 2 % noise
  SpikedSpeed,    ///< nothing is missing, and one sample in the record is far off
  OneStroke,      ///< one stroke over a guide that drags along its length, not in time
  SteadyFurnace,  ///< only coefficients are off; constant heating, coarse ADC beyond its noise
  CoarseTank,     ///< only coefficients are off; levels on a lattice coarser than the noise
};

/// All of them, in the order above.
std::vector<Bench> all_benches();

/// A bench of this kind; the seed decides its numbers.
BenchCase bench(Bench kind, std::uint64_t seed);

}  // namespace lacuna::hidden
