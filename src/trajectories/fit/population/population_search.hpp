// SPDX-License-Identifier: MIT
// The population of the largest likelihood, and what is known of it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "marginal_likelihood.hpp"
#include "trajectories/fit/fit_search.hpp"

namespace lacuna {

/// A population at the maximum of its likelihood.
struct PopulationMinimum {
  PopulationValues values;
  PopulationState state;
  std::vector<bool> no_spread;  ///< spreads that the records do not show: they are 0
  bool converged = false;
  int starts = 1, agreeing = 1;  ///< from how many starts, how many came to the same
  bool in_time = true;           ///< whether no deadline came before the last start
  bool whole = true;             ///< or a deadline ended the search for this maximum
};

/// Maximises the likelihood over typical values, spreads and sizes of noise together. A spread
/// that adds less than a deviance of 0.02 is 0.
/// @param guesses own numbers of the records to start from.
PopulationMinimum maximise(FitEngine& engine, const PopulationProblem& problem,
                           const PopulationValues& start, const std::vector<Vector>& guesses,
                           const RunContext& context);

/// The same from several starts: the numbers as given, and those that meet all records alike,
/// as if nothing varied. Steps of integration are as fine as the individual paths need them.
/// @param start the numbers as given in all rows.
PopulationMinimum search_population(FitEngine& engine, const PopulationProblem& problem,
                                    const FitPoint& start, bool only_given,
                                    const RunContext& context);

/// What is known of the coordinates at the maximum.
struct PopulationErrors {
  Matrix covariance;        ///< by the observed information; 0 where nothing is said
  std::vector<bool> known;  ///< whether a number has an error
  /// One for each spread: where the deviance, least over all else, is that of the one-sided
  /// 97.5 % limit; of spreads that are 0 only.
  std::vector<std::optional<double>> at_most;
  /// One for each spread: whether the deviance of no spread is below that limit.
  std::vector<bool> may_be_zero;
};

/// Those of which nothing is known. @param coordinates how many there are.
PopulationErrors unknown_errors(const PopulationProblem& problem, Index coordinates);

/// Errors from second differences of the likelihood at its maximum, with spreads that are 0 and
/// numbers at the ends of their ranges held. @throws OutOfTime past the deadline.
PopulationErrors errors_of_population(FitEngine& engine, const PopulationProblem& problem,
                                      const PopulationMinimum& minimum,
                                      const RunContext& context);

}  // namespace lacuna
