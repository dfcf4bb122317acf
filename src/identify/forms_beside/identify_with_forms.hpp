// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// Identifies with the library of the pipeline and with forms beside it that are no polynomials
/// (function_forms(), missing_forms()). These are the answer where the library does not reach
/// the noise of the record and they do, or leave less, and where they are equivalent with fewer
/// parameters, shapes counted. The model of the library alone stands beside it
/// (IdentificationResult::library_alone). A pipeline with libraries of single equations is run
/// as it is.
/// A team divides the run without forms; its leader looks for them.
/// @throws as identify().
/// A run without forms comes first, and with_forms_beside() goes on from it.
IdentificationResult identify_with_forms(const RecordStream& records, const Pipeline& pipeline,
                                         const std::vector<Stage<Effect>>& effects,
                                         const FormOptions& options = {},
                                         const RunContext& context = {});

/// The second half of it, which goes on from what the library gives.
/// @param alone of identify() with the same pipeline on the same records.
/// @throws as identify(); OutOfTime past the deadline.
IdentificationResult with_forms_beside(const RecordStream& records, const Pipeline& pipeline,
                                       const std::vector<Stage<Effect>>& effects,
                                       IdentificationResult alone, const FormOptions& options,
                                       const RunContext& context);

}  // namespace lacuna
