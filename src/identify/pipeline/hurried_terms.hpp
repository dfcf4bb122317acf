// SPDX-License-Identifier: MIT
// What is looked at where the time limit leaves no time for all candidates.
#pragma once

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// The terms of the lowest degrees in a library, whole degrees, as many as rows are read of in
/// next to no time; those of the two lowest degrees in any case. What is no product counts as one
/// of two variables.
TermSet cheap_terms(const TermLibrary& library, Index rows, Index targets);

/// Whether rows of so many columns can be read in so many seconds by any machine there is. Past
/// the deadline nothing is left of rows of which not all were read.
bool can_be_read(Index rows, Index columns, double seconds, int threads);

/// The candidates of an equation that orthogonal least squares takes first, so many that all
/// rules are cheap; all of few.
TermSet leading_candidates(const LeastSquaresSystem& system, Index target,
                           const TermSet& candidates, const RunContext& context);

/// The terms of a set that are not in another one; both increase.
TermSet terms_beside(const TermSet& all, const TermSet& some);

}  // namespace lacuna
