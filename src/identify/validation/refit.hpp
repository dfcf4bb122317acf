// SPDX-License-Identifier: MIT
// The coefficients of a model from other records.
#pragma once

#include <optional>

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// A model with the coefficients that the stages of a pipeline give it on other records, as
/// they did on the first: same formulation, same constraints, fitted to the trajectories where
/// that was done. Nothing where these records do not determine all of its terms.
std::optional<IdentificationResult> refitted_result_on(const Dataset& data,
                                                       const OdeModel& model,
                                                       const Pipeline& pipeline,
                                                       const RunContext& context);

/// The same model alone, a fit to the trajectories beginning at the coefficients that it has.
std::optional<OdeModel> refitted_on(const Dataset& data, const OdeModel& model,
                                    const Pipeline& pipeline, const RunContext& context);

}  // namespace lacuna
