// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Sr3.
struct Sr3Options {
  /// What the sparse copy is penalised by.
  enum class Penalty {
    L0,       ///< the number of its terms
    L1,       ///< the sum of their sizes
    Clipped,  ///< the same, sizes beyond `clip` counting as that
  };
  static constexpr std::array<std::string_view, 3> kPenalties{"l0", "l1", "clipped"};

  static constexpr StageInfo kInfo{
      "sr3", "Sparse relaxed regularised regression: a sparse copy near the coefficients.",
      "Zheng, Askham, Brunton, Kutz & Aravkin, IEEE Access 7 (2019) 1404; Champion, Zheng, "
      "Aravkin, Brunton & Kutz, IEEE Access 8 (2020) 169259"};

  double threshold = 0.01;
  Penalty penalty = Penalty::L0;
  double clip = 5.0;
  double relaxation = 1.0;
  int max_iterations = 10000;

  void describe(OptionVisitor& v) {
    v.field({"threshold", "", "Terms of the copy below this fraction of |y| are zero.", 0.0},
            threshold);
    v.field({"penalty", "",
             "Of the copy: 'l0' keeps or drops, 'l1' takes the threshold off all terms, "
             "'clipped' off the small ones."},
            kPenalties, penalty);
    v.field({"clip", "thresholds", "Size from which 'clipped' lets terms be.", 1.0, 1e9}, clip);
    v.field(
        {"relaxation", "",
         "nu: how far the copy may be from the coefficients; columns have unit norm.", 1e-9},
        relaxation);
    v.field({"max_iterations", "", "Most steps.", 1.0, 1e9}, max_iterations);
  }
};

/// Relaxed sparse regression in columns of unit norm, z_j = h_j |theta_j|:
///
///   min_{z,w} 1/2 |c - R z|^2 + 1/(2 nu) |z - w|^2 + lambda p(w),
///   z <- (R'R + I/nu)^-1 (R'c + w/nu),   w <- argmin_w 1/2 |z - w|^2 + nu lambda p(w).
///
/// With the limit t = threshold |y| the last step is, entry by entry,
///
///   l0:       z where |z| >= t, else 0                          (nu lambda = t^2 / 2)
///   l1:       sign(z) max(|z| - t, 0)                           (nu lambda = t)
///   clipped:  z where |z| >= (clip + 1/2) t, else that of l1    (p = sum min(|w|, clip t)).
///
/// Starts with w of least squares. Each step lowers the objective. The terms of w get the
/// coefficients of plain least squares.
class Sr3 final : public Configured<Regressor, Sr3Options> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
