// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A stretch of a record with initial states of its own. Samples are counted through all
/// trajectories, one behind the other.
struct Window {
  Index first = 0;      ///< its first sample
  Index samples = 0;    ///< samples compared with the record
  Index intervals = 0;  ///< sampling intervals simulated: up to the next window or the end
};

/// Windows of equal weight in the fit, in the order of time.
using WindowPlan = std::vector<Window>;

/// How errors grow and turn along a record, from the matrices of the variational equations.
struct ErrorGrowth {
  /// Phi of every sampling interval, scaled by the spread of the states: row i is the m x m
  /// matrix of interval i, column by column.
  Matrix transitions;

  Index dimension = 0;  ///< m
};

/// Bounds on the windows.
struct WindowLimits {
  double growth = 3.0;  ///< largest singular-value bound |Phi|_F / sqrt(m) over a window

  /// Largest sum of |Phi - 1|_F / sqrt(m) over the intervals of a window: its length in units
  /// of the local time scale. Infinite: no bound.
  double turn = 6.3;

  Index shortest = 2;  ///< samples, where the record has them
  Index longest = 2;   ///< samples
};

/// Cuts trajectories into windows, each as long as the limits let it be; the samples of a
/// trajectory are shared out so that no window is much shorter than the one before it.
/// @param begins first sample of each trajectory, then the number of all samples.
/// @throws ArgumentError when begins do not increase, there are not the matrices of each
///   interval, or a window may have no sample.
WindowPlan plan_windows(const std::vector<Index>& begins, const ErrorGrowth& growth,
                        const WindowLimits& limits);

/// The same number of samples in each window, as far as trajectories go.
/// @throws ArgumentError when begins do not increase or a window has no sample.
WindowPlan equal_windows(const std::vector<Index>& begins, Index samples);

/// Largest |Phi|_F / sqrt(m) that errors reach within any window of a plan.
double largest_growth(const WindowPlan& plan, const ErrorGrowth& growth);

}  // namespace lacuna
