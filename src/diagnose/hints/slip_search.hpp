// SPDX-License-Identifier: MIT
#pragma once

#include "slips.hpp"
#include "window_rates.hpp"

namespace lacuna {

/// Misfit e_k^2 of each equation (see look_at()), from 0 to 2; 2 where the model has no finite
/// rates in a tenth of the windows.
/// @param measured, modelled windows x m.
Vector misfit(const Matrix& measured, const Matrix& modelled);

/// A slip that takes nearly all of the misfit away.
struct FoundSlip {
  Slip slip;
  Vector before, after;           ///< misfit of each equation
  std::vector<Slip> others = {};  ///< that do so as well, with no more channels
};

/// The slip that does so best; of those that do so about as well the one with the fewest
/// channels.
///
/// A slip is taken for one where, undone, it leaves a small fraction of the misfit (geometric
/// mean of the rms over the equations that it changes), where no equation fits worse, and, for
/// a factor, where the factor that the records themselves determine is the one on the list.
std::optional<FoundSlip> find_slip(const OdeModel& model, const Dataset& data,
                                   const RateWindows& windows, const HintOptions& options);

}  // namespace lacuna
