// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/l1_solver.hpp"

namespace lacuna {

/// Options of CoordinateDescent.
struct CoordinateDescentOptions {
  static constexpr StageInfo kInfo{"coordinate-descent",
                                   "Soft-thresholds one coefficient after the other.",
                                   "Friedman, Hastie & Tibshirani, J. Stat. Softw. 33 (2010)"};

  double tolerance = 1e-12;
  int max_sweeps = 1000;

  void describe(OptionVisitor& v) {
    v.field({"tolerance", "", "Ends when the optimality conditions hold to this.", 1e-15, 1.0},
            tolerance);
    v.field({"max_sweeps", "", "Most passes over the coefficients.", 1.0, 1e9}, max_sweeps);
  }
};

/// Cyclic coordinate descent in closed form,
///   z_j <- S(z_j G_jj + (R'(c - R z))_j, p_j / 2) / G_jj,  G = R'R, S the soft threshold,
/// ended by the optimality conditions (see l1_violation). A sweep decides which coefficients
/// come in; after each, those that are in go to their common minimum (see l1_face_minimum), so
/// that the number of sweeps does not grow with the condition of R.
class CoordinateDescent final : public Configured<L1Solver, CoordinateDescentOptions> {
 public:
  using Configured::Configured;

 private:
  L1Solution do_solve(const L1Problem& problem, const RunContext& context) const override;
};

}  // namespace lacuna
