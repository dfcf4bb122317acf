// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/solvers/least_squares.hpp"

namespace lacuna {

/// What nlopt_l1() makes.
class NloptL1 final : public Configured<L1Solver, NloptL1Options> {
 public:
  using Configured::Configured;

  /// Why it cannot be used: "" or "built without NLopt".
  static std::string unavailable();

 private:
  /// @throws ConfigError when built without NLopt.
  L1Solution do_solve(const L1Problem& problem, const RunContext& context) const override;
};

}  // namespace lacuna
