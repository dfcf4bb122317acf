// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/run_context.hpp"
#include "lacuna/diagnosis/diagnosis.hpp"
#include "lacuna/hypotheses/rank.hpp"

namespace lacuna {

/// How a model is diagnosed.
struct DiagnosisOptions {
  std::vector<Stage<Effect>> effects;        ///< that are tried
  std::vector<CoefficientPrior> tolerances;  ///< of nominal coefficients
  int max_effects = 4;
  double significance = 3.0;  ///< standard deviations, after allowing for all that was tried
  /// Smallest part of a state's rate of change that is of substance; what is less may come from
  /// the arithmetic that made or sampled the records.
  double substance = 1e-3;
  RankOptions rank = {};
  bool fill_gap = false;  ///< structure without a name gets a spline as a stop-gap
};

/// Finds what a nominal model lacks: brings it onto the records, locates the disagreement,
/// tells wrong coefficients, noise with a memory and outliers from missing structure, adds
/// effects one after another with a look back, and gauges the result on records that were not
/// used.
/// @param data records to find effects in; their states and inputs are those of the model.
/// @param held_out records to gauge on; when empty the last quarter of each record in `data` is
///   kept back.
/// @throws DataError, ArgumentError when the records do not fit the model; Cancelled.
Diagnosis diagnose(const OdeModel& nominal, const Dataset& data, const Dataset& held_out,
                   const DiagnosisOptions& options, const RunContext& context);

}  // namespace lacuna
