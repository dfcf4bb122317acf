// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/term_pruner.hpp"

namespace lacuna {

/// Options of InformationCriterion.
struct InformationCriterionOptions {
  /// What is minimised.
  enum class Criterion {
    Bic,           ///< n ln(RSS / n) + k ln n
    Aicc,          ///< n ln(RSS / n) + 2 k + 2 k (k + 1) / (n - k - 1)
    EffectiveBic,  ///< BIC with n / tau for n, tau by serial_correlation()
  };

  static constexpr StageInfo kInfo{
      "information-criterion",
      "Backward elimination to the number of terms that an information criterion prefers.",
      "Schwarz, Ann. Stat. 6 (1978) 461; Hurvich & Tsai, Biometrika 76 (1989) 297"};
  static constexpr std::array<std::string_view, 3> kCriteria{"bic", "aicc", "bic-effective"};

  Criterion criterion = Criterion::Bic;
  double resolution = 1e-11;

  void describe(OptionVisitor& v) {
    v.field({"criterion", "", "Which criterion is minimised."}, kCriteria, criterion);
    v.field(
        {"resolution", "",
         "Residuals below this fraction of |y| and of the terms count as rounding.", 0.0, 1.0},
        resolution);
  }
};

/// Takes out, one by one, the term whose loss raises the residual least, refitting each time,
/// and keeps the set with the smallest BIC or AICc, RSS = |y - Theta_A h|^2. Right where the
/// residual is independent noise; where it is not, n rows are not n independent ones and too
/// many terms stay: the effective BIC counts as many rows as the residuals of all terms are
/// worth. The systematic error of a derivative is predictable, and terms that describe it stay.
/// Depends on n as the criteria do, not on units or time scale.
class InformationCriterion final : public Configured<TermPruner, InformationCriterionOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                       const Regressor& regressor, const RunContext& context) const override;
};

}  // namespace lacuna
