// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {

/// Whether a form has another one with fewer shape parameters as a special case: tanh(v/w) has
/// sign(v), for a small w, x - l*tanh(x/l) has x^3 beside x, for a large l.
///
/// Both are taken at the scope's samples, what the nominal terms of the equation can do is
/// projected out, and the shapes of the general form are searched in their ranges for the one
/// that follows the special form most closely. It is one where no more than a thousandth of its
/// square is left. Forms in different places or of different arguments, with delays or memory
/// states (which samples do not determine) never nest.
/// @param values of the special form's shape parameters.
bool nests(const Candidate& general, const Candidate& special, const Vector& values,
           const Scope& scope);

}  // namespace lacuna
