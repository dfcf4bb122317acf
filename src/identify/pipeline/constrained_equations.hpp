// SPDX-License-Identifier: MIT
// Coefficients of all equations together, under constraints.
#pragma once

#include "equation_terms.hpp"
#include "lacuna/identify/pipeline/result.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// Fits the coefficients of a result again, so that they satisfy the constraints: least squares
/// over all equations, each weighted by its residual. Terms that constraints ask for enter the
/// model and the trail.
/// @throws ConfigError where the terms of the model cannot satisfy them.
void satisfy_constraints(const LeastSquaresSystem& system, const EquationLibraries& libraries,
                         IdentificationResult& result);

}  // namespace lacuna
