// SPDX-License-Identifier: MIT
// The search for shape parameters and designs: without derivatives, in a box scaled to the unit
// cube.
#pragma once

#include "nelder_mead.hpp"

namespace lacuna {

/// Where the function is least, starting from a point in [0,1]^d; never worse than the start.
/// By NLopt and the method of the settings; unless that is CubeMethod::Sbplx, set up again where
/// it has ended on a face, as long as that helps. nelder_mead() where lacuna is built without
/// NLopt.
/// @param function is called with points of the cube only; its exceptions end the search.
/// Source: Rowan, "Functional stability analysis of numerical algorithms", thesis, University of
/// Texas at Austin (1990); Box, Computer J. 8:42-52 (1965).
Vector least_in_cube(FunctionRef<double(const Vector&)> function, const Vector& start,
                     const SimplexSettings& settings);

/// Whether least_in_cube() is NLopt's: lacuna was built with it.
bool searches_by_nlopt();

}  // namespace lacuna
