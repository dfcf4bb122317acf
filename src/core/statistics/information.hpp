// SPDX-License-Identifier: MIT
// What a parameter and a choice cost in -2 log likelihood: all penalties are made of these two.
#pragma once

#include <algorithm>
#include <cmath>

namespace lacuna {

/// Penalty for one parameter by the Bayesian information criterion: log n for n samples, 0 for
/// less than one. Schwarz, Ann. Statist. 6 (1978), 461.
inline double parameter_penalty(double samples) { return std::log(std::max(1.0, samples)); }

/// Penalty for what was the best of so many candidates: log(tried), half of what the extended
/// criterion asks with its weight 1. Chen and Chen, Biometrika 95 (2008), eq. (1).
inline double choice_penalty(double tried) { return std::log(std::max(1.0, tried)); }

}  // namespace lacuna
