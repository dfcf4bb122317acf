// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/trajectories/sensitivities/linearised_record.hpp"

namespace lacuna {

/// Per equation the longest time by which something in it is late, m entries; 0 where nothing
/// is.
Vector longest_delays(const OdeModel& model);

/// What delayed values from before a record may do to the states: each lies anywhere in the
/// range that its variable has in the record, for all of the time T by which it is late. A rate
/// that changes by r over that range moves the state by T r / sqrt(12) then, which is what a
/// disturbance of the spectral density T r^2 / 12 does.
/// @return LinearisedRecord::bridge, m x (n-1); empty for a model without delays.
Matrix unknown_past(const OdeModel& model, const LinearisedRecord& record);

}  // namespace lacuna
