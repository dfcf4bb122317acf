// SPDX-License-Identifier: MIT
// Measurement noise that grows with the signal.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/trajectories/refiners.hpp"

namespace lacuna {

/// Noise whose standard deviation grows with the signal x: sqrt(floor^2 + (fraction x)^2).
struct NoiseGrowth {
  double floor = 0.0;  ///< unit of the signal
  double fraction = 0.0;

  double at(double x) const;
};

/// Differences of one order: the signal where each was taken (a mean, of which the difference
/// is independent), and their sizes.
struct SizedDifferences {
  Vector signal;
  Vector sizes;
};

/// Whether noise grows with the signal. Differences are put into groups by the size of the
/// signal; the robust deviations s_g of the groups are fitted by
///   log s_g = log sqrt(floor^2 + (fraction x_g)^2),   var log s_g = 1.36 / n_g
/// (median absolute deviation of n_g normal values). Nothing where that is not better than one
/// deviation for all by the rule's significance. A group whose deviation goes on falling from
/// order to order shows the signal and does not count. Nothing either where differences in
/// units of the growing noise are not of unit variance, or where it is a smaller fraction of
/// the value than instruments have.
/// @param orders differences of rising order, from one on that shows the noise.
std::optional<NoiseGrowth> noise_growth(const std::vector<SizedDifferences>& orders,
                                        const GrowingNoise& rule);

/// Standard deviation of the noise of every sample.
struct SampleNoise {
  std::vector<Matrix> deviations;  ///< per record n x m
  Vector rms;                      ///< m, over all samples
  std::vector<std::optional<NoiseGrowth>> growth;
};

/// Where the noise of a state is white and noise_growth() sees it grow, it does; else every
/// sample has the same.
/// @param sigma of each state.
SampleNoise noise_of_samples(const Dataset& data, const Vector& sigma,
                             const std::vector<StateNoise>& noise, const GrowingNoise& rule,
                             int threads = 1);

}  // namespace lacuna
