// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/refiners/no_refiner.hpp"

namespace lacuna {

RefinedModel NoRefiner::do_refine(const RefinerTask& task, const RunContext&) const {
  return {.model = task.start, .usable = false};
}

}  // namespace lacuna
