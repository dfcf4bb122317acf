// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Frols.
struct FrolsOptions {
  static constexpr StageInfo kInfo{
      "frols", "Forward selection by orthogonal least squares: the best next term, again.",
      "Chen, Billings & Luo, Int. J. Control 50 (1989) 1873; Billings 2013, ch. 3"};

  std::optional<double> threshold = {};
  double penalty = 1.0;
  int max_terms = 50;

  void describe(OptionVisitor& v) {
    v.field({"threshold", "",
             "Ends when the next term reduces the error by less than this fraction of |y|^2; "
             "by the score when not given.",
             0.0, 1.0},
            threshold);
    v.field({"penalty", "", "Penalty for a term in the score, in log n; 1 is that of the BIC.",
             0.0},
            penalty);
    v.field({"max_terms", "", "Most terms.", 1.0, 1e6}, max_terms);
  }
};

/// Forward regression with orthogonal least squares: takes the term with the largest error
/// reduction ratio
///
///   ERR_j = (w_j' y)^2 / (|w_j|^2 |y|^2),  w_j = theta_j without its parts in the terms taken,
///
/// again and again; ends by `threshold`, or where the score of SubsetScore (BIC) along the way
/// is least. The coefficients are those of least squares on the terms taken.
class Frols final : public Configured<Regressor, FrolsOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
