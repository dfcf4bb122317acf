// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/l1_solver.hpp"

namespace lacuna {

/// Options of NloptL1.
struct NloptL1Options {
  static constexpr StageInfo kInfo{
      "nlopt", "Limited-memory BFGS of NLopt on the split form z = p - q.",
      "Johnson, The NLopt package; Nocedal, Math. Comput. 35 (1980) 773"};

  int max_evaluations = 5000;

  void describe(OptionVisitor& v) {
    v.field({"max_evaluations", "", "Most evaluations of the objective.", 1.0, 1e9},
            max_evaluations);
  }
};

/// Splits the coefficients into parts that cannot be negative,
///   min_{p,q >= 0} |c - R(p - q)|^2 + sum_j penalty_j (p_j + q_j),  z = p - q,
/// which is smooth with bounds, and gives it to NLopt (L-BFGS) in runs of 10 evaluations for
/// each coefficient. After each the nonzero coefficients go to their common minimum (see
/// l1_face_minimum), until the optimality conditions hold.
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
