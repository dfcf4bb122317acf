// SPDX-License-Identifier: MIT
// The search from starts anywhere in the ranges of parameters.
#pragma once

#include <vector>

#include "core/base/random.hpp"
#include "lacuna/core/base/types.hpp"
#include "trajectories/fit/fit_search.hpp"

namespace lacuna {

/// Whether searches from other starts are not likely to find more: the least of the deviances that
/// they ended with was reached three times, and fewer than one minimum is expected that none of n
/// searches with w different ends has found,
///   w (n - 1) / (n - w - 2) - w < 1
/// (Boender and Rinnooy Kan, Mathematical Programming 37:59-80, 1987).
/// @param alike deviances that differ by less are of the same minimum.
bool is_settled(std::vector<double> deviances, double alike);

/// Fits from starts over the ranges, in rounds: from each some steps are made, and the better half
/// goes on to its minimum, the sizes of the noise fitted in turn. Each start is the best of a few
/// draws. Steps of the integration are best implicit ones, whose error is controlled wherever a
/// start is. Rounds end when they are settled; a start that was left counts with where it was.
/// @param found gets each minimum. @param ended called for each start that was left.
/// @return whether they are settled.
bool search_ranges(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                   const FitSearchOptions& options, const RunContext& context,
                   FunctionRef<void(FitMinimum)> found, FunctionRef<void()> ended);

}  // namespace lacuna
