// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/solvers/least_squares.hpp"

namespace lacuna {

/// What ceres_l1() makes.
class CeresL1 final : public Configured<L1Solver, CeresL1Options> {
 public:
  using Configured::Configured;

  /// Why it cannot be used: "" or "built without Ceres".
  static std::string unavailable();

 private:
  /// @throws ConfigError when built without Ceres.
  L1Solution do_solve(const L1Problem& problem, const RunContext& context) const override;
};

}  // namespace lacuna
