// SPDX-License-Identifier: MIT
// One process that acts in two equations has one form.
#pragma once

#include "search.hpp"

namespace lacuna {

/// Effects with the same argument in two equations that have different forms get one of the two
/// in both, where that explains the records as well (DecisionOptions::undecided): what acts
/// between two bodies or two stores acts on both alike, with a fraction of its own, and noise
/// alone makes another form a little likelier in one of them. Shape parameters stay those of
/// each.
/// @return whether a form was changed.
bool agree_on_forms(const EffectSearch& search, FoundEffects& found);

}  // namespace lacuna
