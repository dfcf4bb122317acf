// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Ridge.
struct RidgeOptions {
  static constexpr StageInfo kInfo{"ridge", "Least squares with a penalty on large terms.",
                                   "Hoerl & Kennard, Technometrics 12 (1970) 55; Hoerl, "
                                   "Kennard & Baldwin, Commun. Statist. 4 (1975) 105"};

  std::optional<double> alpha = {};

  void describe(OptionVisitor& v) {
    v.field({"alpha", "",
             "Penalty on the squared norms |h_j theta_j|^2 of the terms; from the residual when "
             "not given.",
             0.0},
            alpha);
  }
};

/// Ridge regression: minimises |y - Theta h|^2 + alpha sum_j |h_j theta_j|^2. The penalty is in
/// columns of unit norm, so that it does not depend on units. Shrinks every coefficient, most
/// where columns are alike, and removes none. Without an alpha it is that of Hoerl, Kennard &
/// Baldwin 1975, for the coefficients z_j = h_j |theta_j| of least squares on k terms and n rows,
///
///   alpha = k s^2 / |z|^2,  s^2 = |y - Theta h|^2 / (n - k),
///
/// so that the bias stays below the scatter, however many the rows are and however small a noise
/// they have: of 4000 whitened rows a fixed one of 1e-6 hid the structure.
class Ridge final : public Configured<Regressor, RidgeOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
