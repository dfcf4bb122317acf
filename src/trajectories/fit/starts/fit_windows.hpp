// SPDX-License-Identifier: MIT
// Where all states are measured: numbers fitted in windows, from a state in each.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "trajectories/fit/fit_solver.hpp"

namespace lacuna {

/// Numbers that were fitted in windows.
struct FitInWindows {
  FitPoint point;              ///< with the states at the begins of the records
  std::vector<Index> begins;   ///< samples at which windows begin, in rising order
  bool meets_records = false;  ///< whether nothing but noise is left in them
};

/// Multiple shooting from the numbers given (refine()): windows are as long as errors that grow
/// along the records let them be. Nothing where they cannot begin anywhere: a state that has no
/// value at some sample, initial values that are given, numbers that each record has for
/// itself, delays, events.
/// @param view records in the variables of the model, those of the engine.
/// Past a deadline the windows are those that it has come to.
std::optional<FitInWindows> fitted_in_windows(const FitEngine& engine,
                                              const FitUnknowns& unknowns, const Dataset& view,
                                              const RunContext& context);

/// Records cut where windows begin, each piece a record of its own.
Dataset cut_at(const Dataset& records, const std::vector<Index>& begins);

}  // namespace lacuna
