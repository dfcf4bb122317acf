// SPDX-License-Identifier: MIT
// What an assimilation takes turns at: each step makes one of another.
#pragma once

#include <vector>

#include "lacuna/trajectories/smoother/assimilation.hpp"
#include "trajectories/smoother/variance_fit.hpp"

namespace lacuna {

/// What every step works with. Everything outlives it.
struct AssimilationTask {
  const Dataset& data;
  const AssimilationOptions& options;
};

/// Whether the model has rates, and these have slopes, all along the paths.
bool is_linearised(const Assimilation& state);

/// Per record n x m.
std::vector<Matrix> paths_of(const Assimilation& state);

/// Linearised along the paths; what effects have bridged stays bridged.
Assimilation relinearised(const AssimilationTask& task, Assimilation state);

/// relinearised() where the model has rates: on the path that was found, or between it and the
/// one before.
Assimilation relinearised_in_reach(const AssimilationTask& task, Assimilation state,
                                   const std::vector<Matrix>& before);

/// With the variances of the largest likelihood and the smoother's path under them. What is
/// learnt of the likelihood's curvature is kept in `variances` for the next turn.
Assimilation with_noise_and_path(Assimilation state, VarianceFit& variances);

/// With the coefficients of the least squares of whitened innovations, and what these predict
/// beyond the path; the deviance is the one that the linearisation promises.
Assimilation with_fitted_coefficients(const AssimilationTask& task, Assimilation state);

}  // namespace lacuna
