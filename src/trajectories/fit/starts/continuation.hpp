// SPDX-License-Identifier: MIT
// From a filter that holds the model on the record to its free run.
#pragma once

#include "../fit_search.hpp"

namespace lacuna {

/// Residuals over the noise that the samples show, the largest of all channels; infinite where
/// the noise is not known.
double excess_of_noise(const FitEngine& engine, const FitUnknowns& unknowns,
                       const FitMinimum& found);

/// Where fits with filters end.
struct Continued {
  FitMinimum best;
  bool departs = false;  ///< see FitSearch
};

/// Fits with filters of falling disturbance, then the free run (see search_fit()). Where that does
/// not meet the noise and the filter does, with ever smaller disturbances: errors of a chaotic
/// model grow along a record, and the next free run begins nearer.
/// Past the deadline it ends with what it has come to, the minimum not `in_time`.
Continued continued(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& point,
                    const FitSearchOptions& options, const RunContext& context);

}  // namespace lacuna
