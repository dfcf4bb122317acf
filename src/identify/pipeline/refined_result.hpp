// SPDX-License-Identifier: MIT
#pragma once

#include "equation_terms.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/regression/stages/refiner.hpp"

namespace lacuna {

/// Records and what is known of their noise.
struct KnownRecords {
  const Dataset& data;
  const KnownNoise& noise;
};

/// Refines the model of a result and enters what became of it: model, noise, fits, trail, path,
/// warnings. @return false when the refiner left the model as it was.
bool apply_refiner(const Refiner& refiner, const KnownRecords& records,
                   const EquationLibraries& libraries, IdentificationResult& result,
                   const RunContext& context);

/// The measured state whose samples test the equation of a state: itself, or the one whose
/// derivative it is.
std::optional<Index> tested_by(const Dataset& data, Index state);

/// What the fits of equations say by themselves.
Adequacy adequacy_of_equations(const std::vector<EquationFit>& fits);

}  // namespace lacuna
