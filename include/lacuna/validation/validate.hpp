// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/candidates/effect.hpp"
#include "lacuna/pipeline/pipeline.hpp"

namespace lacuna {

/// Where the verdicts of a validation part.
struct ValidationOptions {
  /// Errors may be above the noise by this share, as the noise is known no better.
  double noise_slack = 0.1;

  /// And by so many standard deviations of the rms of as many normal values. As many of the
  /// correlation of neighbouring residuals tell structure from noise that is white, however
  /// small it is.
  double scatter = 4.0;

  /// Errors below this share of the motion are those of the solver that made a record without
  /// noise, of its digits and of the interpolation of inputs.
  double resolution = 2e-4;

  /// An error of a larger share of the motion is no approximation.
  double wrong_share = 0.1;

  /// Degrees of freedom below which a test says nothing.
  double least_freedom = 30.0;
};

/// What is judged.
struct ValidationTask {
  const IdentificationResult& result;
  const Dataset& data;                   ///< what the model was identified from
  const Pipeline& pipeline;              ///< that identified it
  std::optional<Dataset> held_out = {};  ///< records in the states and inputs of the model
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
/// is held against the noise that the samples show by themselves (analyse_noise()) and against
/// the motion, the error of a model without rates.
///
/// Without records of their own a quarter of the samples is held out, in blocks evenly spread,
/// and the coefficients are fitted without them by the stages of the pipeline; terms and shapes
/// are those of the whole record.
/// @throws DataError as check_dataset().
Validation validate(const ValidationTask& task, const ValidationOptions& options = {},
                    const RunContext& context = {});

/// What to try where a model does not fit: for each of its equations the form that the residual
/// asks for, if one stands out (FormSearch), else `lacuna diagnose`.
std::vector<std::string> advice_for(const IdentificationResult& result, const Dataset& data,
                                    const std::vector<Stage<Effect>>& effects,
                                    const RunContext& context = {});

}  // namespace lacuna
