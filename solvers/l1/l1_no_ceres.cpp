// SPDX-License-Identifier: MIT
#include "solvers/l1/l1_ceres.hpp"

namespace lacuna {

std::string CeresL1::unavailable() { return "built without Ceres"; }

L1Solution CeresL1::do_solve(const L1Problem&, const RunContext&) const {
  throw ConfigError("l1-solver ceres", unavailable(),
                    "install Ceres and build again, or use coordinate-descent");
}

}  // namespace lacuna
