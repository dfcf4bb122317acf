// SPDX-License-Identifier: MIT
// Where else a fit may begin.
#pragma once

#include <optional>
#include <vector>

#include "core/base/random.hpp"
#include "trajectories/fit/fit_search.hpp"

namespace lacuna {

/// Another start: parameters off by a random factor up to `spread`, hidden states anywhere
/// where the model is defined.
FitPoint other_start(FitEngine& engine, const FitUnknowns& unknowns, FitPoint point,
                     double spread, Random& random);

/// The start with hidden states one spread from it all at once: levels and concentrations are
/// all positive. Nothing where no state is guessed.
std::optional<FitPoint> raised(FitEngine& engine, FitPoint point, double sign);

/// The start with hidden states that begin at the edge of where the model is defined one spread
/// inside of it: at the edge of a root the residuals have no slope.
FitPoint off_edges(FitEngine& engine, FitPoint point);

/// Whether a range is positive and so wide that starts about another one do not come to its ends.
bool is_wide(double lower, double upper, double spread);

/// Whether some parameter that all records share has a wide range.
bool has_wide_range(const FitUnknowns& unknowns, double spread);

/// So many starts that are spread evenly over all finite ranges, by logarithms where a range is
/// positive: a Latin hypercube (McKay, Beckman and Conover, Technometrics 21:239, 1979). What has
/// no range, and hidden states, are as in other_start().
std::vector<FitPoint> starts_over_ranges(FitEngine& engine, const FitUnknowns& unknowns,
                                         const FitPoint& start, int count, double spread,
                                         Random& random);

}  // namespace lacuna
