// SPDX-License-Identifier: MIT
// Coefficients of all equations together, under constraints.
#pragma once

#include <optional>
#include <vector>

#include "equation_terms.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// Fits the coefficients of a result again, so that they satisfy the constraints: least squares
/// over all equations, each weighted by its residual. Terms that constraints ask for enter the
/// model and the trail; a term whose coefficient is 0 because it is bounded by 0 leaves.
/// @return numbers of the bounds that hold as equalities.
/// @throws ConfigError where the terms of the model cannot satisfy them.
std::vector<std::size_t> satisfy_constraints(const LeastSquaresSystem& system,
                                             const EquationLibraries& libraries,
                                             IdentificationResult& result);

/// The number of the bound that a model violates most beyond rounding; nothing where it satisfies
/// all.
std::optional<std::size_t> most_violated(const EquationLibraries& libraries,
                                         const OdeModel& model);

}  // namespace lacuna
