// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Power spectral density of each state.
struct PowerSpectrum {
  Vector frequency;  ///< 0 .. 1/(2h), per time unit
  Matrix density;    ///< frequencies x m, state unit squared times time unit, one-sided
};

/// Welch's estimate (IEEE Trans. Audio Electroacoust. 15:70-73, 1967): segments that overlap by
/// half, their mean removed, under a Hann window. Its sum times the spacing of the frequencies
/// is about the variance.
/// @param segments number of non-overlapping segments the record is divided by.
/// @throws ArgumentError when the record is not uniform or a segment has fewer than 8 samples.
/// The same when a sample or its square is not finite, or rows and times differ in number.
PowerSpectrum power_spectrum(const Trajectory& record, Index segments = 16);

/// Hellinger's distance of two spectra, each normalised to the sum 1, the mean over the states:
/// sqrt(1 - sum_f sqrt(p_f q_f)); 0 for equal shapes, 1 for spectra without a common frequency.
/// Both records are cut to the shorter one's length, so that the frequencies are the same.
/// @throws ArgumentError as power_spectrum(), and when states or sampling steps differ.
double power_spectrum_distance(const Trajectory& a, const Trajectory& b, Index segments = 16);

}  // namespace lacuna
