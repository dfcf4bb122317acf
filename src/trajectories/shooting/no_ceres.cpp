// SPDX-License-Identifier: MIT
#include "block_minimum.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {

std::string ceres_is_absent() { return "built without Ceres"; }

BlockMinimum minimise_blocks_by_ceres(BlockProblem&, BlockPoint, const BlockTask&,
                                      const RunContext&) {
  throw ConfigError("least squares by Ceres", ceres_is_absent(),
                    "install Ceres and build again, or use the own method");
}

}  // namespace lacuna
