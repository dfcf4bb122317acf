// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/term_pruner.hpp"

namespace lacuna {

/// Options of CrossValidation.
struct CrossValidationOptions {
  static constexpr StageInfo kInfo{
      "cross-validation",
      "Backward elimination to the fewest terms that predict blocks left out as well as any.",
      "Burman, Chow & Nolan, Biometrika 81 (1994) 351; Breiman et al., CART (1984) 78"};

  int blocks = 10;
  double standard_errors = 1.0;
  double resolution = 1e-11;

  void describe(OptionVisitor& v) {
    v.field({"blocks", "", "Contiguous blocks of rows, each left out once.", 2.0, 1000.0},
            blocks);
    v.field(
        {"standard_errors", "",
         "So many standard errors above the least prediction error are as good as it.", 0.0},
        standard_errors);
    v.field(
        {"resolution", "",
         "Residuals below this fraction of |y| and of the terms count as rounding.", 0.0, 1.0},
        resolution);
  }
};

/// The number of terms by h-block cross-validation, the terms by backward elimination.
///
/// The rows are divided into B contiguous blocks. Each is left out once, with a gap to either
/// side as long as the residuals of all terms are correlated (serial_correlation), at most half
/// a block: neighbours in time would determine the block beforehand. In the other rows the
/// terms leave one by one, the one whose loss raises the residual least first, and each set
/// predicts the block, by least squares:
///
///   e_bk = |y_b - Theta_b h_k|^2, h_k fitted with k terms to the rows outside of b and its
///   gaps.
///
/// The smallest k is taken whose sum of e exceeds the least one by no more than so many
/// standard errors of the difference, from its scatter over the blocks. k terms are then left
/// of the elimination in all rows with the given regressor. Depends on the noise of the record
/// only through what it makes of predictions; needs neither its size nor a threshold.
class CrossValidation final : public Configured<TermPruner, CrossValidationOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                       const Regressor& regressor, const RunContext& context) const override;
};

}  // namespace lacuna
