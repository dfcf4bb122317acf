// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna::hidden {

/// What a measurement adds to the states. Each has the standard deviation `level` times that of
/// the state.
enum class NoiseKind {
  White,      ///< Gaussian, independent
  Coloured,   ///< Gaussian, first-order low pass with a time constant of 5 samples
  Outliers,   ///< white, and in 1 % of the samples a spike of 5 to 10 standard deviations more
  Quantised,  ///< rounding to a grid of sqrt(12) * level standard deviations
  Clipped,    ///< white, and an end of the range at a tenth of the samples on either side
  Dropouts,   ///< white, and in bursts of 3 to 8 samples, 5 % in all, the last value again
  Slow,       ///< white, and the last state has a value at every fifth sample only
  Averaged,   ///< white, then means over 9 samples, over fewer at the ends
  Parabolas,  ///< white, then least-squares parabolas through 15 samples, fewer at the ends
  Drifting,  ///< a slow sensor offset (half a period over the record) and white, equally strong
};

/// "white", "coloured", ...
std::string to_string(NoiseKind kind);

/// The record as it is measured; derivatives that came with it are dropped, inputs stay exact.
/// @param level relative to the standard deviation of each state over the record.
Dataset disturbed(const Dataset& clean, NoiseKind kind, double level, std::uint64_t seed);

}  // namespace lacuna::hidden
