// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The part of a record that a model speaks of: its states and inputs, found by name among all
/// columns (a record's states may hold an input of the model), in the order of the model. A
/// column with the name of an output that is just a state measures that state.
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

/// The same for a record in which not all states are measured. States that the model defines as
/// derivatives (`q` is there and its equation is the single term `v`: v = dq/dt) are made from
/// it and marked as reconstructed; q and all others are as smooth as the differentiator makes
/// them then (see embed()). Other states without a column are hidden: 0, marked as
/// reconstructed, with all samples marked as missing (see is_hidden()). Behind the m states
/// there is one column for each output that is a formula (see measured_outputs()). Time and
/// columns with units come to those of the model; what nothing converts is noted and stays.
/// @throws DataError for an input or an output without a column and where nothing is measured,
///   and as embed() and in_time_unit_of().
Dataset model_view(const OdeModel& model, const Dataset& record,
                   const Differentiator& differentiator);

/// Whether the first states and inputs of records are those of a model, in its order.
bool is_view(const OdeModel& model, const Dataset& data);

/// Refuses records whose first states and inputs are not those of a model in its order.
/// @throws DataError naming the first one that is not there; model_view() puts them so.
void check_is_view(const OdeModel& model, const Dataset& data);

/// Whether no sample of any record shows anything of a state.
bool is_hidden(const Dataset& data, Index state);

/// Where hidden states begin as far as a model says so (OdeModel::initial()), or 0; m entries.
Vector given_begin(const OdeModel& model);

/// An output of a model and where it is in a view: a column of Trajectory::states behind those
/// of the m states, with marks and noise as theirs.
struct MeasuredOutput {
  Output output;
  Index column = 0;
};

/// The outputs of a view in a model's variables that are channels of their own.
std::vector<MeasuredOutput> measured_outputs(const OdeModel& model, const Dataset& view);

/// Refuses records of which an output is a formula, for those who cannot work with them.
/// @throws DataError naming the first one.
void check_outputs_are_states(const OdeModel& model, const Dataset& view);

}  // namespace lacuna
