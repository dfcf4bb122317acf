// SPDX-License-Identifier: MIT
// Which of the parameters are known, and between which limits.
#pragma once

#include <optional>
#include <vector>

#include "fit_errors.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "profiles.hpp"

namespace lacuna {

/// Which profiles of the likelihood are followed.
enum class ProfileUse {
  None,
  Cheap,   ///< ends of intervals, where the work is moderate
  Always,  ///< ends of intervals
  Curves,  ///< ends of intervals and points between them
};

/// A minimum with what is known of its numbers.
struct KnownNumbers {
  FitMinimum minimum;  ///< that of the search, or a lower one that a profile led to
  FitErrors errors;
  Vector reach = {};  ///< G: quantiles of Student's t distribution
  std::vector<std::optional<NumberProfile>> profiles = {};  ///< G
  bool in_time = true;  ///< whether no deadline came before the last profile
};

/// Errors, and profiles of the likelihood. Numbers in directions of which nothing is known have
/// none. Past the deadline there are no profiles.
KnownNumbers known_numbers(FitEngine& engine, const FitUnknowns& unknowns,
                           const FitMinimum& minimum, ProfileUse use,
                           const RunContext& context);

/// Estimates with standard errors and intervals. A number whose likelihood reaches the end of
/// its range, or far off, has none of them but the limit on its other side.
std::vector<FittedParameter> numbers_of(const FitEngine& engine, const FitUnknowns& unknowns,
                                     const KnownNumbers& known);

/// The profiles as curves.
std::vector<FitProfile> curves_of(const FitEngine& engine, const FitUnknowns& unknowns,
                                  const KnownNumbers& known);

/// Adds what is to be said of numbers without an interval that are in no combination: the limit
/// on one side, or that there is none.
void add_limits(const std::vector<FittedParameter>& numbers,
                std::vector<FitCombination>& combinations);

}  // namespace lacuna
