// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/trajectories/refiners.hpp"

namespace lacuna {

/// What trajectory_selection() makes.
class TrajectorySelection final : public Configured<Refiner, TrajectorySelectionOptions> {
 public:
  using Configured::Configured;

 private:
  RefinedModel do_refine(const RefinerTask& task, const RunContext& context) const override;
};

}  // namespace lacuna
