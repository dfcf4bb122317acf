// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/solvers/least_squares.hpp"

namespace lacuna {

/// What coordinate_descent() makes.
class CoordinateDescent final : public Configured<L1Solver, CoordinateDescentOptions> {
 public:
  using Configured::Configured;

 private:
  L1Solution do_solve(const L1Problem& problem, const RunContext& context) const override;
};

}  // namespace lacuna
