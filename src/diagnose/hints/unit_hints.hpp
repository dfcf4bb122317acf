// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "diagnose/hints/hints.hpp"
#include "window_rates.hpp"

namespace lacuna {

/// Two channels each in a unit of the other (rpm for rad beside deg for rad/s) look swapped,
/// and that is the hint. Else channels in a unit that nothing converts to that of the model
/// (Inkr beside rad), each with the factor that the records suggest: the one with the least
/// misfit of the rates. It is Withheld::Answer where that factor, and not 1, takes the misfit
/// away, else a remark.
std::vector<Hint> unit_hints(const OdeModel& model, const BoundRecords& records,
                             const RateWindows& windows, const HintOptions& options);

}  // namespace lacuna
