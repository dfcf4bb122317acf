// SPDX-License-Identifier: MIT
// A stop-gap beside named effects: polynomials in the equations that have structure left.
#pragma once

#include <optional>

#include "hypotheses/free_input.hpp"

namespace lacuna {

/// Adds to each equation that has structure left the monomials of the states that it lacks, to
/// degree 3 while there are no more than 35 of them, else to degree 2 or 1, and fits all
/// coefficients jointly; those that are not significant are taken out again. Many small terms
/// of which none is of substance by itself are found so only together. They stand behind the
/// named effects and have no names.
/// @return nothing where the polynomials do not explain more than they cost (BIC).
std::optional<Explanation> with_polynomials(const Unexplained& problem,
                                            const std::vector<EquationStructure>& left,
                                            const Explanation& explanation);

}  // namespace lacuna
