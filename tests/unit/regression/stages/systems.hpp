// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/random.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// 20 rows of three terms, of which the second is zero everywhere, and two targets.
inline LeastSquaresSystem small_system() {
  Random random(4);
  Matrix theta(20, 3), targets(20, 2);
  for (Index i = 0; i < 20; ++i) {
    theta.row(i) << random.normal(), 0.0, random.normal();
    targets.row(i) << theta(i, 0) - theta(i, 2), random.normal();
  }
  return LeastSquaresSystem(make_row_source(theta, targets), {"a", "zero", "b"}, {"p", "q"});
}

}  // namespace lacuna
