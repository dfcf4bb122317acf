// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of BestSubset.
struct BestSubsetOptions {
  static constexpr StageInfo kInfo{"best-subset",
                                   "The best of all sets of terms, proved by branch and bound.",
                                   "Furnival & Wilson, Technometrics 16 (1974) 499; Gatu & "
                                   "Kontoghiorghes, J. Comput. Graph. "
                                   "Stat. 15 (2006) 139"};

  int max_terms = 8;
  double penalty = 1.0;
  double most_operations = 2e10;

  void describe(OptionVisitor& v) {
    v.field({"max_terms", "", "Most terms of a set.", 1.0, 1000.0}, max_terms);
    v.field({"penalty", "",
             "Penalty for a term in the score, in log n; 1 is that of the BIC, 0 gives the "
             "best set of max_terms terms.",
             0.0},
            penalty);
    v.field({"most_operations", "",
             "The search ends after about so many; then the set is not proved to be the best "
             "(not converged).",
             1.0},
            most_operations);
  }
};

/// Of all sets of at most `max_terms` terms the one with the least score of SubsetScore,
///
///   2 n log(|y - Theta_S h_S| / |y|) + penalty |S| log n,
///
/// with the coefficients of least squares. Branches of the search are triangles: a branch has
/// columns that all its sets contain, in front, and columns that they may contain. Leaving out
/// the k-th column, for each k, makes the branches below it (those before it are then in all
/// sets); the residual of all columns of a branch bounds those of its sets from below. Columns
/// are ordered by what leaving them out costs, so that most branches end at once.
class BestSubset final : public Configured<Regressor, BestSubsetOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
