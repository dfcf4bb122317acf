// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace lacuna {

/// Where f is least on [low, high]: the best of a grid, then golden section in its two
/// neighbouring cells down to a twentieth of the spacing.
/// @throws ArgumentError when the range is empty or the spacing is not positive.
double least_on_grid(const std::function<double(double)>& f, double low, double high,
                     double spacing);

}  // namespace lacuna
