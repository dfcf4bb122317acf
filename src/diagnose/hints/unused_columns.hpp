// SPDX-License-Identifier: MIT
#pragma once

#include "diagnose/hints/hints.hpp"
#include "window_rates.hpp"

namespace lacuna {

/// Columns that the model does not know and that explain, linearly, a major part of what an
/// equation lacks: of the windows' rates without what the nominal terms, the states, the
/// inputs, a constant and a straight line in time can do, and without their noise.
/// Significances count as many windows as are independent, by the column and by what it leaves
/// (Bartlett, J. R. Stat. Soc. 98:536, 1935). For each equation that is no identity the column
/// that explains most.
/// @param unused the records with these columns as inputs.
std::vector<Hint> unused_column_hints(const OdeModel& model, const BoundRecords& records,
                                      const Dataset& unused, const RateWindows& windows,
                                      const HintOptions& options);

}  // namespace lacuna
