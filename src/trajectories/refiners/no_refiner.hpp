// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/trajectories/refiners.hpp"

namespace lacuna {

/// What no_refiner() makes.
class NoRefiner final : public Configured<Refiner, NoRefinerOptions> {
 public:
  using Configured::Configured;

 private:
  RefinedModel do_refine(const RefinerTask& task, const RunContext& context) const override;
};

}  // namespace lacuna
