// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/dataset.hpp"
#include "lacuna/model/ode_model.hpp"
#include "lacuna/stages/differentiator.hpp"

namespace lacuna {

/// The part of a record that a model speaks of: its states and inputs, found by name among all
/// columns (a record's states may hold an input of the model), in the order of the model.
/// Derivatives that came with the record are left out, inputs are n x p also where p is 0.
/// With it a record drives a simulation:
/// @code
///   const Dataset view = model_view(model, record);
///   const Trajectory& run = view.trajectories[0];
///   RecordInput input(run);
///   simulate(DrivenModel{model, input}, Rk4{}, run.states.row(0).transpose(), run.time);
/// @endcode
/// @throws DataError naming a state or an input of the model that the record does not have.
Dataset model_view(const OdeModel& model, const Dataset& record);

/// The same for a record in which states are missing that the model defines as derivatives
/// (`q` is there and its equation is the single term `v`: v = dq/dt): they are made from it
/// and marked as reconstructed; q and all others are as smooth as the differentiator makes
/// them then (see embed()). Time is brought to the unit of the model (see
/// in_time_unit_of()).
/// @throws DataError as above, and as embed() and in_time_unit_of().
Dataset model_view(const OdeModel& model, const Dataset& record,
                   const Differentiator& differentiator);

}  // namespace lacuna
