// SPDX-License-Identifier: MIT
#include "shape_search.hpp"

namespace lacuna {

Vector least_in_cube(FunctionRef<double(const Vector&)> function, const Vector& start,
                     const SimplexSettings& settings) {
  return nelder_mead(function, start, settings);
}

bool searches_by_nlopt() { return false; }

}  // namespace lacuna
