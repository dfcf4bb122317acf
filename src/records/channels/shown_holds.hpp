// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// How an input goes on between samples as far as its samples show: Hold::Zero where most of
/// them repeat the one before in every record in which it moves (shows_hold()), else
/// Hold::Smooth; nothing where it never moves.
/// @throws ArgumentError when there is no such input.
std::optional<Hold> shown_hold(const Dataset& data, Index input);

/// The records with Hold::Zero for those inputs of which nothing is said and whose samples show it;
/// nothing where there is none.
std::optional<Dataset> with_shown_holds(const Dataset& data);

/// Inputs whose samples hold (Hold::Zero), by number.
std::vector<Index> held_inputs(const Dataset& data);

/// The model with the shown holds of those inputs of which it does not say how they go on.
/// @param data in the inputs of the model.
OdeModel with_shown_holds(const OdeModel& model, const Dataset& data);

}  // namespace lacuna
