// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "trajectories/windows/windows.hpp"

namespace lacuna {

/// Cramer-Rao bound: the least standard deviation of each parameter that an unbiased estimate
/// can have from samples with Gaussian noise, the initial state of each window being unknown.
///
///   sqrt(diag((sum_w S_p' (1 - Q_w Q_w') S_p)^-1)),  rows of S_p over sigma, Q_w spanning the
///   derivatives with respect to the initial state of window w.
///
/// With one window a trajectory (equal_windows with the number of samples) it is the bound on
/// any method; on a chaotic orbit of many Lyapunov times nothing reaches that.
/// @param model at the true parameters; @param truth record of the true states, without noise.
/// @param sigma noise of each state that the record has.
/// @return P entries; infinite where the record shows nothing.
/// @throws ArgumentError when sigma does not fit; DataError as refine().
/// @throws ArgumentError unless there is one positive sigma per state, and windows lie in the
///   record.
Vector cramer_rao_bound(const ParametrisedModel& model, const Dataset& truth,
                        const Vector& sigma, const WindowPlan& windows);

}  // namespace lacuna
