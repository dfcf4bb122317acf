// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/identify/options.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// What is judged.
struct ValidationTask {
  const IdentificationResult& result;
  const Dataset& data;                   ///< what the model was identified from
  const Pipeline& pipeline;              ///< that identified it
  std::optional<Dataset> held_out = {};  ///< records in the states and inputs of the model
  KnownNoise noise = {};                 ///< of `data`
};

/// Judges an identified model by its predictions on samples that it was not fitted to.
///
/// Two tests, both in windows with initial states that fit best: the shortest windows that
/// leave a residual (two samples where all states are measured: the residual is the error of
/// one step, weighed by the noise of both samples), and windows of a mean period, in which a
/// chaotic model has no time to diverge. In each, for each measured state,
///
///   error = sqrt(sum r^2 / freedom),   freedom = sum (1 - leverage),
///
/// is compared with the noise that the samples show by themselves (analyse_noise()) and against
/// the motion, the error of a model without rates.
///
/// Without records of their own a quarter of the samples is held out, in blocks evenly spread,
/// and the coefficients are fitted without them by the stages of the pipeline; terms and shapes
/// are those of the whole record.
/// @throws DataError as check_dataset(), and as check_are_others() for records of their own;
///   ArgumentError when known noise is not one per state.
Validation validate(const ValidationTask& task, const ValidationOptions& options = {},
                    const RunContext& context = {});

/// Enters a validation into the result that it judges. Predictions are better evidence than
/// residuals of derivatives: where they determine it, they decide whether an equation fits to
/// the noise, and what the residuals said against it goes.
/// @param data what the model was identified from.
void take_in(Validation validation, const Dataset& data, IdentificationResult& result);

}  // namespace lacuna
