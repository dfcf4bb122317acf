// SPDX-License-Identifier: MIT
#pragma once

#include "equation_terms.hpp"
#include "lacuna/identify/pipeline/result.hpp"
#include "lacuna/regression/stages/refiner.hpp"

namespace lacuna {

/// Refines the model of a result and enters what became of it: model, noise, fits, trail, path,
/// warnings. @return false when the refiner left the model as it was.
bool apply_refiner(const Refiner& refiner, const Dataset& data,
                   const EquationLibraries& libraries, IdentificationResult& result,
                   const RunContext& context);

}  // namespace lacuna
