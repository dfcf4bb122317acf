// SPDX-License-Identifier: MIT
#pragma once

#include "residual_analysis.hpp"
#include "trajectories/shooting/refine.hpp"

namespace lacuna {

/// Where a refinement starts.
struct RefinementStart {
  Matrix guess;   ///< states to start from, N x m
  Vector noise;   ///< of each measured state: of the record or as given
  Vector spread;  ///< standard deviation of each state in the guess, m
};

/// What a refinement came to.
struct RefinementRun {
  bool simulated = false;  ///< whether there are windows in which the model can be simulated
  ShootingFit fit;         ///< of the last windows
  FitInfluence influence;  ///< of that fit; empty where the model cannot be simulated
  int iterations = 0;      ///< of all fits on the way
  bool in_time = true;     ///< whether no deadline came before the last polish
};

/// Noise and states to start from, as given or from the record.
/// @throws ArgumentError, DataError as refine().
RefinementStart refinement_start(ShootingProblem& problem, const Dataset& data,
                                 const RefineOptions& options);

/// One refinement: windows from short to long, the search for windows where the model is not
/// exact, the last polish. The problem gets the noise of the residuals, where none is given,
/// and a scheme that is accurate enough beside it.
/// @throws DataError, ArgumentError as refine().
RefinementRun run_refinement(ShootingProblem& problem, const RefinementStart& start,
                             const RefineOptions& options, const RunContext& context);

}  // namespace lacuna
