// SPDX-License-Identifier: MIT
// Search without derivatives in a box that is scaled to the unit cube.
#pragma once

#include "lacuna/core/function_ref.hpp"
#include "lacuna/core/types.hpp"

namespace lacuna {

/// Where the function is least, starting from a point in [0,1]^d.
/// @param reach size of the first simplex.
/// Source: Nelder and Mead, Computer J. 7:308-313 (1965); points that leave the cube are put on
/// its faces.
Vector nelder_mead(FunctionRef<double(const Vector&)> function, const Vector& start,
                   double reach, int evaluations);

}  // namespace lacuna
