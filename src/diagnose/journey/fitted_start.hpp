// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The nominal model with the coefficients that fit() finds for its structure: what a refit
/// explains is no structure. Where every state is measured linearised fits come there too.
/// Nothing where no run is finite, or the deadline comes first.
/// @param model as it was given, with its outputs; @param nominal the same with output channels
/// as states. @param measured records in the variables of the model that may choose.
/// @param noise of each column of these.
std::optional<OdeModel> fitted_start(const OdeModel& model, const OdeModel& nominal,
                                     const Dataset& measured, const std::vector<StateNoise>& noise,
                                     const RunContext& context);

}  // namespace lacuna
