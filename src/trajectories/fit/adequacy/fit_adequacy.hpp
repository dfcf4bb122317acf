// SPDX-License-Identifier: MIT
// Whether what a fit leaves of the records is noise.
#pragma once

#include "lacuna/trajectories/fit/fit.hpp"
#include "residual_test.hpp"
#include "trajectories/fit/fit_solver.hpp"

namespace lacuna {

/// The residuals of a minimum in the order in which they are tested. Numbers at the ends of
/// their ranges, fixed initial values, and those that are known better beforehand than the
/// record shows them take no direction.
struct MinimumResiduals {
  FittedResiduals residuals;
  FittedDirections directions;
};

MinimumResiduals residuals_of(FitEngine& engine, const FitUnknowns& unknowns,
                              const FitMinimum& minimum);

/// Per cent of a fit that leaves nothing but the rounding of a file.
inline constexpr double kExactFit = 99.999;

/// Judges the free run: writes into `quality` what its residuals show, and gives the one value
/// of which all sentences are made. A channel fits where structure of the residuals has a
/// probability of 5 % or more by chance, and the samples would show one as large as the noise
/// with a probability of 80 %; it does not fit where that of chance is below 5 %.
Adequacy adequacy_of_run(FitEngine& engine, const FitUnknowns& unknowns,
                         const FitMinimum& minimum, std::uint64_t seed,
                         std::vector<FitQuality>& quality);

}  // namespace lacuna
