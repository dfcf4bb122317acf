// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "diagnose/journey/gap.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// How a model runs freely in windows of one mean period of records whose states are all known:
/// in each window from the initial state that fits best. GapRecord::before is empty. A record
/// that is too short for that, or in which the model has no finite solution anywhere, is left
/// out.
/// @param noise m entries, standard deviations of the measurement; 0 where none is known.
std::vector<GapRecord> free_runs(const OdeModel& model, const Dataset& data,
                                 const Vector& noise);

}  // namespace lacuna
