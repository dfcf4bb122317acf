// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Sr3.
struct Sr3Options {
  static constexpr StageInfo kInfo{
      "sr3", "Sparse relaxed regularised regression: a sparse copy near the coefficients.",
      "Zheng, Askham, Brunton, Kutz & Aravkin, IEEE Access 7 (2019) 1404; Champion, Zheng, "
      "Aravkin, Brunton & Kutz, IEEE Access 8 (2020) 169259"};

  double threshold = 0.01;
  double relaxation = 1.0;
  int max_iterations = 10000;

  void describe(OptionVisitor& v) {
    v.field({"threshold", "", "Terms of the copy below this fraction of |y| are zero.", 0.0},
            threshold);
    v.field(
        {"relaxation", "",
         "nu: how far the copy may be from the coefficients; columns have unit norm.", 1e-9},
        relaxation);
    v.field({"max_iterations", "", "Most steps.", 1.0, 1e9}, max_iterations);
  }
};

/// Relaxed l0 regression in columns of unit norm, z_j = h_j |theta_j|:
///
///   min_{z,w} 1/2 |c - R z|^2 + 1/(2 nu) |z - w|^2 + lambda |w|_0,
///   z <- (R'R + I/nu)^-1 (R'c + w/nu),   w <- z where |z_j| >= threshold |y|, else 0,
///
/// so lambda = (threshold |y|)^2 / (2 nu); starts with w of least squares. Each step lowers the
/// objective. The terms of w get the coefficients of plain least squares.
class Sr3 final : public Configured<Regressor, Sr3Options> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
