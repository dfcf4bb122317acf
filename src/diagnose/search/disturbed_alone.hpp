// SPDX-License-Identifier: MIT
// Where a search starts when states are hidden.
#pragma once

#include <optional>

#include "lacuna/diagnose/hypotheses/problem.hpp"

namespace lacuna {

/// The nominal model on the records, as given, with no disturbance but that of one equation;
/// its coefficients are free in what follows. A hidden state whose equation may be disturbed
/// takes the place of what is missing elsewhere; where its equation holds it does not, and what
/// is missing shows in the equation that lacks it.
Assimilation disturbed_alone(const Problem& problem, const Baseline& base, Index equation);

/// The same with a little disturbance everywhere, from which a fit of effects starts.
Assimilation loosened(Assimilation start, const Baseline& base);

}  // namespace lacuna
