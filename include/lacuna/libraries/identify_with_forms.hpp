// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/candidates/effect.hpp"
#include "lacuna/pipeline/pipeline.hpp"

namespace lacuna {

/// Identifies with the library of the pipeline and, where that does not reach the noise of the
/// record in some equation, with forms beside it that are no polynomials (function_forms(),
/// missing_forms()), chosen by the same pipeline. The result is the one that fits; the model of
/// the library alone stands beside it (IdentificationResult::library_alone).
/// @throws as identify().
IdentificationResult identify_with_forms(const Dataset& data, const Pipeline& pipeline,
                                         const std::vector<Stage<Effect>>& effects,
                                         const RunContext& context = {});

}  // namespace lacuna
