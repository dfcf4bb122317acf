// SPDX-License-Identifier: MIT
#include "trajectories/refiners/no_refiner.hpp"

namespace lacuna {

RefinedModel NoRefiner::do_refine(const RefinerTask& task, const RunContext&) const {
  return {.model = task.start, .usable = false};
}

Stage<Refiner> no_refiner(const NoRefinerOptions& options) { return NoRefiner(options); }

}  // namespace lacuna
