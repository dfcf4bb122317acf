// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// How far the times of samples scatter about those that the record gives.
struct TimingJitter {
  double deviation = 0.0;  ///< of a sample's time, time units; 0 where none is seen
  double sigma = 0.0;      ///< its significance, in standard deviations
  double fraction = 0.0;  ///< largest fraction that it has in the variance of a channel's noise
};

/// A sample that is taken at another time than the record shows is off by the state's rate
/// times the difference, in all channels together: with residuals e = measured - path, rates r
/// of the path and noise of deviation s,
///   E e_j e_k = s_j^2 [j = k] + d^2 r_j r_k,
/// from which d^2 is the weighted least-squares slope over samples and pairs of channels, each
/// pair with its own mean; var e_j e_k = (1 + [j = k]) s_j^2 s_k^2.
TimingJitter timing_jitter(const Assimilation& fit);

}  // namespace lacuna
