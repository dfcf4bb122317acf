// SPDX-License-Identifier: MIT
// How well a fitted model meets records.
#pragma once

#include "fit_search.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// Significance of the correlation of residuals in time, in standard deviations: Ljung and Box,
/// Biometrika 65:297-303 (1978), of lags 1 .. 20 within records, as far as these go.
/// @param residuals in deviations of their noise, N x c, 0 for what is no value (whitened()).
double correlation_sigma(const FitEngine& engine, const Matrix& residuals, Index channel);

/// Whether no channel's residuals are correlated in time beyond chance.
bool are_white(const FitEngine& engine, const Matrix& residuals);

/// Of each channel, from samples of each record from `skip` on.
std::vector<FitQuality> quality_of(FitEngine& engine, const FitPoint& point,
                                   const FitPath& path, Index ahead, Index skip);

/// Free runs of held-out records with the numbers as given and as fitted.
/// @param usual mean and deviation of each state along the fitted paths, m x 2.
/// @param unknowns local: those of a held-out record are fitted, as its initial states are, on
///   its first FitOptions::window samples; those that vary about the numbers used.
/// @return nothing where no sample is left behind those that give initial states.
std::optional<FitGap> gap_of(const ParametrisedModel& model, const FitPoint& fitted,
                             const Dataset& held_out, const Matrix& usual,
                             const FitOptions& options, const FitUnknowns& unknowns,
                             const RunContext& context = {});

}  // namespace lacuna
