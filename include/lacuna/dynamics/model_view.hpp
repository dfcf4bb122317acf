// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/dataset.hpp"
#include "lacuna/model/ode_model.hpp"

namespace lacuna {

/// The part of a record that a model speaks of: its states and inputs, found by name, as
/// columns in the order of the model. With it a record drives a simulation:
/// @code
///   const Dataset view = model_view(model, record);
///   const Trajectory& run = view.trajectories[0];
///   RecordInput input(run);
///   simulate(model, Rk4{}, run.states.row(0).transpose(), run.time, input);
/// @endcode
/// @throws DataError naming a state or an input of the model that the record does not have.
Dataset model_view(const OdeModel& model, const Dataset& record);

}  // namespace lacuna
