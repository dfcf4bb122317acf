// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"

namespace lacuna {

/// So many samples in a row may be outliers together.
inline constexpr Index kLongestRun = 3;

/// Samples that may be outliers of the measurement: those of outlying_samples() at which the
/// record is smooth but for them. Where a fast stretch is sampled coarsely no cubic goes
/// through the neighbours of a sample either, which says nothing of the sample. The first and
/// the last one are compared with a parabola through the six next to them. Two or three samples
/// in a row are outliers together where the record jumps there and back and is smooth before and
/// behind; not where such stretches are more than a hundredth of the samples, and recur.
/// @param noise as analyse_noise() has it, m entries.
/// @param deviations of the noise that a sample must be off.
/// @return per record the marks of its samples, n x m, with those that may be one.
std::vector<Matrix> mark_outliers(const Dataset& data, const std::vector<StateNoise>& noise,
                                  double deviations = kOutlyingDeviations);

}  // namespace lacuna
