// SPDX-License-Identifier: MIT
#include "solvers/l1/l1_nlopt.hpp"

namespace lacuna {

std::string NloptL1::unavailable() { return "built without NLopt"; }

L1Solution NloptL1::do_solve(const L1Problem&, const RunContext&) const {
  throw ConfigError("l1-solver nlopt", unavailable(),
                    "install NLopt and build again, or use coordinate-descent");
}

}  // namespace lacuna
