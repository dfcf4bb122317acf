// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {

/// Functions of states and inputs that are no polynomials, as candidates for one equation: what
/// the effects propose that acts at once (no memory, no delay, no function of time), and the
/// functions of a library that no effect has a name for: sin and cos with a frequency, exp,
/// logistic, Hill, x / (1 + x^2/a^2), sqrt, log, powers. Each form once.
std::vector<Candidate> function_forms(const Scope& scope,
                                      const std::vector<Stage<Effect>>& effects,
                                      Index equation);

}  // namespace lacuna
