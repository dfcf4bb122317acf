// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hidden/support/hidden_case.hpp"
#include "hidden/support/records.hpp"

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

/// Of the measurement noise, relative to the states, where no lattice takes its place.
inline constexpr double kBenchNoise = 0.005;

/// All of them, in the order above.
std::vector<Bench> all_benches();

/// A case with its records.
struct BenchCase {
  HiddenCase hidden;
  Records records = {};
  Records clean = {};                        ///< the same without noise
  std::vector<std::string> forbidden = {};  ///< names that no answer may have
};

/// A bench of this kind; the seed decides its numbers.
BenchCase bench(Bench kind, std::uint64_t seed);

}  // namespace lacuna::hidden
