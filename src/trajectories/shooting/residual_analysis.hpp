// SPDX-License-Identifier: MIT
#pragma once

#include "shooting_fit.hpp"
#include "trajectories/shooting/residual_statistics.hpp"

namespace lacuna {

/// What the fit does to the residuals of each measured state. With H the projector on the
/// columns of the linear problem (parameters and initial states), residuals of white noise have
/// the covariance 1 - H.
struct FitInfluence {
  Vector taken;   ///< trace of H: degrees of freedom taken from each measured state
  Matrix lagged;  ///< sum of H_{n, n+l} within windows, lags l = 1 .. x measured
  Matrix pairs;   ///< pairs of samples within windows at each lag, lags x measured
};

/// H from the triangles of the linear problem and one more run over its rows.
FitInfluence fit_influence(ShootingProblem& problem, const ShootingFit& fit, Index lags);

/// Statistics of the whitened residuals of a fit.
/// @param noise what the record itself shows (or what was given), per measured state.
std::vector<ResidualStatistics> residual_statistics(const ShootingProblem& problem,
                                                    const ShootingFit& fit,
                                                    const FitInfluence& influence,
                                                    const Vector& noise);

}  // namespace lacuna
