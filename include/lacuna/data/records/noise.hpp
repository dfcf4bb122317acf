// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// What the measurement noise of a state looks like.
enum class NoiseKind {
  None,       ///< none that can be distinguished from the signal: `sigma` is an upper bound
  White,      ///< the same at every spacing of samples
  Coloured,   ///< neighbouring samples have noise in common
  Quantised,  ///< values on a lattice, and no more noise than rounding to it makes
};

/// "none", "white", "coloured", "quantised".
std::string to_string(NoiseKind kind);

/// The measurement noise of one state, estimated from the record itself.
struct StateNoise {
  double sigma = 0.0;  ///< standard deviation, state units
  NoiseKind kind = NoiseKind::None;

  /// Spacing of the lattice on which the values lie, state units.
  std::optional<double> lattice = {};

  double outliers = 0.0;  ///< fraction of samples that are not explained by noise of this sigma
  Index order = 0;        ///< of the differences that show white noise and no signal
  double white = 0.0;     ///< what estimate_noise() has: 0 where no noise can be estimated
};

/// Sizes of a state's differences of one order, with weights of norm 1: of white noise their
/// root mean square is its deviation. n - order entries (none where there are fewer samples, or
/// for orders below 1).
/// @throws ArgumentError when there is no such state, not as many rows as times, or a sample
/// that
///   is not finite.
Vector difference_sizes(const Trajectory& record, Index state, Index order);

/// Deviations of the noise that a sample must be off to be an outlier: one of 5e8 samples of
/// normal noise is.
constexpr double kOutlyingDeviations = 6.0;

/// Estimates the measurement noise of each state.
///
/// - Differences of rising order k kill the smooth signal and leave noise of variance
///   C(2k, k) sigma^2; with d_k the k-th difference, order k gives
///     sigma_k = median(|d_k|) / (0.6745 sqrt(C(2k, k))).
///   The order at which the estimate stops falling is taken; where it falls to the end, noise
///   cannot be distinguished from the signal and the least sigma_k is an upper bound. The
///   median guards against outliers and fast stretches. Grids that are not uniform have divided
///   differences with weights of the same norm.
/// - Values that are whole multiples of a step q have at least the noise q / sqrt(12).
/// - The same estimate from every second and every fourth sample is larger when neighbours have
///   noise in common.
/// - Outliers are counted as outlying_samples() finds them.
/// @param threads that states are divided among.
/// @throws ArgumentError as difference_sizes().
std::vector<StateNoise> analyse_noise(const Dataset& data, int threads = 1);

/// The same of one state. @throws ArgumentError as above, and when there is no such state.
StateNoise analyse_noise_of(const Dataset& data, Index state);

/// Samples of one state that noise of deviation sigma does not explain: e_i = x_i minus the
/// straight line between its neighbours deviates from the median of the e around it by more
/// than `deviations` sigma sqrt(3/2) and by more than `deviations` robust deviations of all e;
/// of neighbours the worst.
/// @param sigma of the noise, one for all or one for each sample.
/// @throws ArgumentError as difference_sizes(), and when there is another number of sigmas.
std::vector<Index> outlying_samples(const Trajectory& record, Index state, double sigma,
                                    double deviations = kOutlyingDeviations);
std::vector<Index> outlying_samples(const Trajectory& record, Index state, const Vector& sigma,
                                    double deviations = kOutlyingDeviations);

/// Standard deviation of white measurement noise per state as by analyse_noise().
/// @return m entries in the units of the states; 0 where no noise can be distinguished from the
/// signal.
/// @throws ArgumentError as difference_sizes().
Vector estimate_noise(const Dataset& data, int threads = 1);

/// The noise of each state of some records, where it is known already.
using KnownNoise = std::optional<std::vector<StateNoise>>;

}  // namespace lacuna
