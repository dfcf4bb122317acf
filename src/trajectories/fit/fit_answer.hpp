// SPDX-License-Identifier: MIT
// What the answers of all fits are made of.
#pragma once

#include <string>
#include <vector>

#include "fit_solver.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// The initial states of each record. @param errors standard errors, R x m or more; NaN where
/// there is none.
std::vector<std::vector<FittedStart>> starts_of(const FitEngine& engine,
                                                const FitUnknowns& unknowns,
                                                const FitPoint& point, const Matrix& errors);

/// Correlations above 0.9 of the global numbers. @param covariance G x G; 0 where there is none.
std::vector<FitCorrelation> correlations_of(const FitEngine& engine,
                                            const FitUnknowns& unknowns,
                                            const Matrix& covariance);

/// The system with the numbers in their places; these get their units.
SystemModel with_numbers(const SystemModel& system, const ParametrisedModel& model,
                         std::vector<FittedParameter>& numbers);

/// The log-likelihood of all values.
double total_of(const std::vector<FitRun>& runs);

/// What searches from more than one start came to, and what to do where one alone came to the
/// best.
std::string searches_sentence(int starts, int agreeing);

/// What is to be said of a fit.
std::vector<std::string> notes_of(const Fit& fit);

/// Mean and deviation of the states along the paths, m x 2.
Matrix usual_states(const FitPath& path);

/// The law of each channel that has one, and how many values are limits only.
void add_laws(const FitEngine& engine, std::vector<FitQuality>& quality);

/// Each record beside its free run.
std::vector<FitRun> runs_of(const FitEngine& engine, const FitPath& path);

}  // namespace lacuna
