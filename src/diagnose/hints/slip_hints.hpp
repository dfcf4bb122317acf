// SPDX-License-Identifier: MIT
#pragma once

#include "slip_search.hpp"

namespace lacuna {

/// A slip in words, with what would mend it.
Hint hint_of(const OdeModel& model, const FoundSlip& found);

/// An identity dq/dt = v of the model that holds in the records but for a factor c that is far
/// from 1, in magnitude or in sign: deviations of both sides go along (correlation 0.9) and
/// their sizes are c apart. One hint for each.
std::vector<Hint> identity_hints(const OdeModel& model, const Dataset& data,
                                 const RateWindows& windows, const HintOptions& options);

}  // namespace lacuna
