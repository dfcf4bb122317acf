// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The model with a state for each output that is a formula and has a column in the records:
/// is_formula_channel(), with the formula as its equation, in the order of the columns.
OdeModel with_output_channels(const OdeModel& model, const Dataset& view);

/// The opposite: a model with such states, perhaps with effects and their memory, with the
/// outputs and the start of the nominal model again.
OdeModel without_output_channels(const OdeModel& model, const OdeModel& nominal);

}  // namespace lacuna
