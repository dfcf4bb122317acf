// SPDX-License-Identifier: MIT
// Also of a library that is built without the back ends: these say so when they are run.
#include "solvers/l1/l1_ceres.hpp"
#include "solvers/l1/l1_coordinate_descent.hpp"
#include "solvers/l1/l1_nlopt.hpp"

namespace lacuna {

Stage<L1Solver> ceres_l1(const CeresL1Options& options) { return CeresL1(options); }

Stage<L1Solver> coordinate_descent(const CoordinateDescentOptions& options) {
  return CoordinateDescent(options);
}

Stage<L1Solver> nlopt_l1(const NloptL1Options& options) { return NloptL1(options); }

}  // namespace lacuna
