// SPDX-License-Identifier: MIT
#pragma once

#include "trajectories/windows/window_gap.hpp"

namespace lacuna {

/// Where a model runs that is free in windows of a record: in each it begins at the initial
/// state that fits best and is left alone from there. What window_squares() compares.
/// @return n x m; NaN outside of whole windows.
Matrix window_paths(const LinearisedRecord& record, const MarkedSamples& measured,
                    const NoiseModel& noise, const WindowGrid& grid);

}  // namespace lacuna
