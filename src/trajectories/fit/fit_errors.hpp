// SPDX-License-Identifier: MIT
// Errors of parameters.
#pragma once

#include "fit_solver.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// What is known of the numbers of a fit.
struct FitErrors {
  Matrix covariance;           ///< G x G of the global parameters; 0 where nothing is said
  std::vector<bool> known;     ///< G: whether a number has an error
  std::vector<bool> at_bound;  ///< G
  Vector free_errors;          ///< G: by the Fisher information, bounds let go; 0: none
  Vector inflation;            ///< G: variance over that of the Fisher information
  Vector freedom;              ///< G: degrees of freedom of the variance
  Matrix starts;               ///< R x (m + locals): standard errors; NaN where there is none
  std::vector<FitCombination> combinations;
  Matrix open;  ///< G x d: directions of which nothing is known, as fractions of the numbers
};

/// @param white whether the residuals are white; else gradients of blocks give the covariance:
///   (J'J)^-1 (sum_b g_b g_b') (J'J)^-1 (Liang and Zeger, Biometrika 73:13-22, 1986).
FitErrors errors_of(FitEngine& engine, const FitUnknowns& unknowns, const FitMinimum& minimum,
                    bool white);

/// The same minimum as near as can be to where the numbers started, in the directions of which
/// nothing is known: they are as they were, or changed by the least fractions.
FitMinimum nearest_minimum(FitEngine& engine, const FitUnknowns& unknowns, FitMinimum minimum,
                           const Matrix& open, const RunContext& context);

}  // namespace lacuna
