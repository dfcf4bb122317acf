// SPDX-License-Identifier: MIT
// Results of a pipeline beside those of the same with fewer candidates in its equations.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// By how much chi squared of one result is above that of another one with the same equations.
double chi_squared_over(const IdentificationResult& one, const IdentificationResult& other);

/// Why terms went, which the restricted run does not know; of the one that was left out on
/// trial what chi squared it would have taken away, and what it had to.
/// @param before trail of the run with all candidates. @param left_out of that equation.
void take_over_trail(const std::vector<TrailEntry>& before, const std::string& equation,
                     const std::string& left_out, std::pair<double, double> decision,
                     std::vector<TrailEntry>& trail);

}  // namespace lacuna
