// SPDX-License-Identifier: MIT
// Search without derivatives in a box that is scaled to the unit cube.
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// How NLopt searches a cube.
enum class CubeMethod {
  BySize,  ///< by Sbplx for one or two numbers, else by Nelder and Mead's method; again from faces
  Sbplx,   ///< by Sbplx however many there are, once: for searches that use up their evaluations
};

/// When and how a search ends and begins.
struct SimplexSettings {
  double reach = 0.05;     ///< size of the first simplex
  double unnoticed = 0.0;  ///< ends when the vertices' values differ by less
  int evaluations = 100;   ///< at most about so many
  CubeMethod method = CubeMethod::BySize;  ///< of least_in_cube(); nelder_mead() is one itself
};

/// Where the function is least, starting from a point in [0,1]^d.
/// Source: Nelder and Mead, Computer J. 7:308-313 (1965); points that leave the cube are put on
/// its faces. A simplex that has collapsed onto a face is set up again from its best vertex as
/// long as that helps.
Vector nelder_mead(FunctionRef<double(const Vector&)> function, const Vector& start,
                   const SimplexSettings& settings);

}  // namespace lacuna
