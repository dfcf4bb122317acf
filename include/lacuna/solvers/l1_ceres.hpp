// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/core/options.hpp"
#include "lacuna/stages/l1_solver.hpp"

namespace lacuna {

/// Options of CeresL1.
struct CeresL1Options {
  static constexpr StageInfo kInfo{
      "ceres", "Levenberg-Marquardt of Ceres on the smooth form z = u^2 - v^2.",
      "Agarwal, Mierle et al., Ceres Solver"};

  int max_iterations = 5000;

  void describe(OptionVisitor& v) {
    v.field({"max_iterations", "", "Most Levenberg-Marquardt steps.", 1.0, 1e6},
            max_iterations);
  }
};

/// Makes the l1 problem a smooth nonlinear least-squares problem of the same minimum,
///   min_{u,v} |c - R(u^2 - v^2)|^2 + sum_j p_j (u_j^2 + v_j^2),  z = u^2 - v^2 entry by entry,
/// which has no local minima besides the global one, and gives it to Ceres. The last point is
/// made exact on its nonzero coefficients where the optimality conditions confirm it.
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
