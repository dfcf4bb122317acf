// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hidden/support/benches.hpp"

namespace lacuna::hidden {

/// What a bench does to the record of a device that lacks nothing but right coefficients, so that
/// it looks as if something were missing. The list was written before anything that it tests
/// was changed.
enum class BenchFault {
  CoarseLattice,   ///< the first channel in steps of 0.1 to 0.4 of its deviation
  RoundedLattice,  ///< steps of 0.02 to 0.1, printed to a digit that is no part of them
  HiddenStates,    ///< only the first state is measured
  NoisyInput,      ///< the input is measured with 1 to 2 % noise
  Smoothed,        ///< all states are means over 5 to 15 samples, or parabolas through so many
  MovingAverage,   ///< the sensor of the first state shows means of its last 3 to 12 samples
  SteadyInput,     ///< the input never changes
  Spikes,          ///< one to four samples of the first state are off by 1 to 8 deviations
};

/// All of them, in the order above.
std::vector<BenchFault> all_bench_faults();

/// "coarse-lattice", "rounded-lattice", ...
std::string to_string(BenchFault fault);

/// A device of twins.hpp that hides nothing, all its coefficients off by up to 30 %, on a bench
/// with this fault; the seed decides the device and all numbers. What a moving average does to a
/// channel may be named as what it is (a lag or skew of the sensor); all other names are forbidden.
BenchCase null_bench(BenchFault fault, std::uint64_t seed);

}  // namespace lacuna::hidden
