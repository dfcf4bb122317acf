// SPDX-License-Identifier: MIT
// Shapes of effects that ended where their ranges do.
#pragma once

#include <optional>
#include <string>

#include "lacuna/diagnose/candidates/explanation.hpp"

namespace lacuna {

/// Whether a shape ended where its range does, up to what a search resolves.
bool is_on_bound(const ShapeParameter& shape, double value);

/// A time of an effect (its delay, how late a channel is sampled, or the time constant with which
/// its memory fades whatever else moves) that ended where its range does; nothing where none did.
/// The range is what records of this step and length show.
/// @param time_unit of the model.
std::optional<double> time_on_bound(const FittedEffect& effect, const std::string& time_unit);

}  // namespace lacuna
