// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/types.hpp"
#include "trajectories/windows/windows.hpp"

namespace lacuna {

/// What the residuals of one measured state look like.
struct ResidualStatistics {
  Index state = 0;     ///< number in the model
  double rms = 0.0;    ///< of y - x, with the degrees of freedom that the fit took away
  double noise = 0.0;  ///< of the record itself, however the model fits (see estimate_noise)
  double chi_squared = 0.0;  ///< sum of r^2 / noise^2 per degree of freedom
  Vector autocorrelation;    ///< of lags 1, 2, ..., within windows, corrected for the fit

  /// Largest departure of a smoothed autocorrelation from white noise, in standard deviations.
  double structure = 0.0;

  bool white = true;     ///< nothing significant left in the autocorrelation
  bool is_noise = true;  ///< white, and not above the noise of the record
};

}  // namespace lacuna
