// SPDX-License-Identifier: MIT
#pragma once

#include "trajectories/sensitivities/rates.hpp"

namespace lacuna {

/// Slopes of the rates with each state, and the rates themselves.
struct SecantSlopes {
  Matrix slopes;  ///< m^2 x rows: df_j/dx_k in row j + m k
  Matrix rates;   ///< rows x m
};

/// Rates and their slopes at rows of slots. Slopes are taken over the reach of a step,
/// |f_k| length / 2 to either side, or over the accuracy, whichever is more: where a model
/// jumps (dry friction, a stop) the derivative at a point says nothing of what a small deviation
/// does, and a jump acts as it does on average.
/// @param slots rows x slots; @param length rows entries: time over which the slope is to hold.
/// @param accuracy m entries.
SecantSlopes secant_slopes(Rates& rates, const Eigen::Ref<const Matrix>& slots,
                           const Eigen::Ref<const Vector>& length, const Vector& accuracy);

}  // namespace lacuna
