// SPDX-License-Identifier: MIT
// Models compared by their free runs.
#pragma once

#include <cmath>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// A model fitted to free runs.
struct FreeRun {
  SystemModel system;          ///< with the numbers that were fitted
  double deviance = INFINITY;  ///< -2 log likelihood
  double independent = 0.0;    ///< of the samples the fraction that white residuals are worth
  std::size_t numbers = 0;     ///< coefficients, shapes, dead times
  double samples = 0.0;
  std::vector<double> significance = {};  ///< |estimate| / standard error of each number
  double over_noise = INFINITY;  ///< residual over noise (rms) of the worst channel

  bool is_finite() const { return std::isfinite(deviance); }
};

/// Fits the numbers of a model and the initial states to free runs through records (fit()),
/// from those that it has. Residuals that are correlated from sample to sample, rho, as
/// those of a model that lacks something are, are worth n (1 - rho) / (1 + rho) samples
/// (Bartlett, J. R. Stat. Soc. 98 (1935) 536). Where no free run is finite the deviance is
/// infinite.
/// @param data records that models are compared on; of long ones a part. @param noise of its
/// states, where it is known. @param rough with the steps of the search, which are too long for
/// slopes of dry friction.
FreeRun free_run(const SystemModel& system, const Dataset& data, const KnownNoise& noise,
                 const RunContext& context, bool rough = true);

/// Whether a model is better than one with fewer parameters: its deviance is smaller by more
/// than ln n for each parameter more (Schwarz), n and the deviance those of as many samples as
/// the residuals of the other one are worth; and each parameter more takes at least a fraction
/// `least` off the residuals (rms).
bool is_worth(const FreeRun& more, const FreeRun& fewer, double least = 0.0);

/// Whether one of two models is to be taken instead of the other: the one with fewer
/// parameters, unless that with more is worth them; with as many the one with the smaller
/// deviance.
bool is_better(const FreeRun& one, const FreeRun& other, double least = 0.0);

}  // namespace lacuna
