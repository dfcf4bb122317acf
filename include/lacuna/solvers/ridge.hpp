// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Ridge.
struct RidgeOptions {
  static constexpr StageInfo kInfo{"ridge", "Least squares with a penalty on large terms.",
                                   "Hoerl & Kennard, Technometrics 12 (1970) 55"};

  double alpha = 1e-6;

  void describe(OptionVisitor& v) {
    v.field({"alpha", "", "Penalty on the squared norms |h_j theta_j|^2 of the terms.", 0.0},
            alpha);
  }
};

/// Ridge regression: minimises |y - Theta h|^2 + alpha sum_j |h_j theta_j|^2. The penalty is in
/// columns of unit norm, so that it does not depend on units. Shrinks every coefficient, most
/// where columns are alike, and removes none.
class Ridge final : public Configured<Regressor, RidgeOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
