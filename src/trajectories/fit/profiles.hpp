// SPDX-License-Identifier: MIT
// Profiles of the likelihood.
#pragma once

#include "fit_errors.hpp"
#include "fit_solver.hpp"

namespace lacuna {

/// The profile of one number: the least cost over all others while it is held.
struct NumberProfile {
  std::vector<double> values = {}, deviance = {};  ///< points that were looked at, values rising
  double limit = 0.0;                    ///< deviance at the ends of the interval
  std::optional<double> low = {}, high = {};  ///< ends; nothing where the likelihood has none
  bool is_open_below = false, is_open_above = false;  ///< up to the end of the range or far off
};

/// What is asked of a profile.
struct ProfileTask {
  double reach = 1.96;      ///< quantile of Student's t distribution
  double error = 0.0;       ///< standard error, where there is one
  double size = 0.0;        ///< of the number as it was given
  double inflation = 1.0;   ///< variance of the number over that of the Fisher information
  bool whole_curve = false; ///< whether points between are wanted too
};

/// Follows the profile of the global number at `place` from the minimum to both sides until the
/// deviance is reach^2 inflation (Venzon and Moolgavkar, Applied Statistics 37:87-94, 1988), to
/// the end of its range, or to 1000 times (a thousandth of) the estimate.
/// @param better receives a minimum that is lower, where one is met on the way; the profile
///   ends there.
NumberProfile profile_of(FitEngine& engine, const FitUnknowns& unknowns,
                         const FitMinimum& minimum, Index place, const ProfileTask& task,
                         std::optional<FitMinimum>& better, const RunContext& context);

/// Entries of the rows of a fit, times the numbers of which there would be profiles: the work.
double profile_work(const FitEngine& engine, const FitUnknowns& unknowns);

}  // namespace lacuna
