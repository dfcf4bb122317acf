// SPDX-License-Identifier: MIT
// The answer of a fit of parameters that vary over records.
#pragma once

#include "lacuna/trajectories/fit/fit.hpp"
#include "trajectories/fit/fit_errors.hpp"
#include "trajectories/fit/starts/fit_windows.hpp"

namespace lacuna {

/// Numbers that were estimated, by whatever method.
struct FitEstimate {
  FitMinimum minimum;
  FitUnknowns unknowns;  ///< local: with those that vary
  FitPoint typical;      ///< with typical values of numbers that vary
  FitErrors errors = {};  ///< of numbers that do not vary over records
  /// Where the model meets the records in windows alone: these. The rest is not made then.
  std::optional<FitInWindows> windows = {};
};

/// Whether a parameter of a model varies over records.
bool varies(const SystemModel& system);

/// @throws DataError where no free run is finite.
[[noreturn]] void throw_no_run();

/// Estimates typical values, spreads and sizes of noise (search_population()), and writes them
/// with their errors into the answer. Intervals of numbers that vary have Student's quantile with
/// one degree of freedom less than there are records; their errors are larger by sqrt(R / (R - 1))
/// there, because the spreads of the largest likelihood are too small by that: exact for the mean
/// of records that are known exactly.
/// @throws DataError where no free run is finite, or where there is one record only.
FitEstimate estimate_population(const SystemModel& system, FitEngine& engine,
                                     const FitUnknowns& unknowns, const FitPoint& start,
                                     const FitOptions& options, const RunContext& context,
                                     Fit& result);

/// Puts the likelihood of the population, its criteria and its notes into an answer of which
/// everything else is known.
void complete_population(Fit& result);

}  // namespace lacuna
