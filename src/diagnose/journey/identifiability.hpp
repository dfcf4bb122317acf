// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "diagnose/hints/hints.hpp"
#include "lacuna/diagnose/hypotheses/problem.hpp"

namespace lacuna {

/// Hints on what the records do not determine where states are hidden: coefficients that they
/// determine only together (directions that were held in the fit), and states on which nothing
/// that was measured depends.
/// @param fit with AssimilationOptions::held_among; without it there are no hints.
std::vector<Hint> identifiability_hints(const Problem& problem, const Baseline& base,
                                        const Assimilation& fit);

/// Whether free coefficient j of a fit has a part in a direction that was held: what is said of
/// its size is that of the nominal model.
bool is_held(const Assimilation& fit, Index j);

}  // namespace lacuna
