// SPDX-License-Identifier: MIT
#pragma once

#include "shooting_fit.hpp"

namespace lacuna {

/// Where windows are looked for when residuals are not noise.
struct InexactWindows {
  const ErrorGrowth& growth;  ///< along the record, scaled
  double largest_growth;      ///< of errors in a window
  Index shortest;             ///< samples
  double tolerance;           ///< of each fit, as in minimise()
  int max_iterations;
};

/// The windows for a model that is not exact. Its residuals are correlated over time, so that
/// the Fisher information says nothing about its parameters; what does are the gradients of 30
/// blocks of the record (block_covariance). Windows are halved and doubled from those of `fit`
/// on as long as the standard errors so estimated do not become worse; of all tried, the
/// longest is taken whose mean log standard error is within one standard error of the best (the
/// rule of Breiman et al. 1984, Sect. 3.4.3).
ShootingFit search_windows(ShootingProblem& problem, const ShootingFit& fit,
                           const InexactWindows& search, const RunContext& context);

}  // namespace lacuna
