// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/l1_solver.hpp"

namespace lacuna {

/// Options of CeresL1.
struct CeresL1Options {
  static constexpr StageInfo kInfo{
      "ceres", "Levenberg-Marquardt of Ceres on smoothed penalties, ever less smooth.",
      "Agarwal, Mierle et al., Ceres Solver"};

  int max_iterations = 2000;

  void describe(OptionVisitor& v) {
    v.field({"max_iterations", "", "Most Levenberg-Marquardt steps.", 1.0, 1e6},
            max_iterations);
  }
};

/// Follows the minimum of the smooth convex problem
///   min_z |c - R z|^2 + sum_j p_j mu (sqrt(1 + z_j^2 / mu^2) - 1)
/// as mu falls from the size of the first guess to 1e-12 of it: the penalties are Ceres'
/// SoftLOneLoss, which tends to p_j |z_j|, and every minimum is the start of the next. After
/// each the optimum of the l1 problem is solved for exactly on the coefficients that are not
/// small, and taken where the optimality conditions confirm it.
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
