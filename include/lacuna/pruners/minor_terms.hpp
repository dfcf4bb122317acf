// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lacuna/core/options.hpp"
#include "lacuna/stages/term_pruner.hpp"

namespace lacuna {

/// Options of MinorTerms.
struct MinorTermsOptions {
  /// What eta means.
  enum class Tolerances {
    Relative,  ///< |residual| <= (1 + eta) |residual of all terms| + floor
    Paper,     ///< |residual| / n <= eta, raw, as in the authors' toolbox
  };
  /// Which term is tried next.
  enum class Criterion {
    Contribution,  ///< the smallest |h_i tau_i|, as published
    Residual,      ///< the one whose loss raises the residual least
  };

  static constexpr StageInfo kInfo{
      "minor-terms", "Drops the least important term and refits while the fit stays good.",
      "Kera & Hasegawa, Nonlinear Dynamics 85 (2016) 675; Karimov et al. 2023, Sect. 2.1"};
  static constexpr std::array<std::string_view, 2> kTolerances{"relative", "paper"};
  static constexpr std::array<std::string_view, 2> kCriteria{"contribution", "residual"};

  Tolerances tolerances = Tolerances::Relative;
  Criterion criterion = Criterion::Residual;
  std::optional<double> eta;
  double resolution = 1e-11;

  /// eta, or the default of the chosen tolerances.
  double effective_eta() const {
    return eta.value_or(tolerances == Tolerances::Relative ? 0.05 : 1e-5);
  }

  void describe(OptionVisitor& v) {
    v.field(
        {"tolerances", "",
         "'relative': eta is a share of the residual of all terms; 'paper': |residual| / n."},
        kTolerances, tolerances);
    v.field(
        {"criterion", "",
         "Next to go: smallest |h tau| ('contribution') or least loss of fit ('residual')."},
        kCriteria, criterion);
    v.field({"eta", "",
             "How much worse the fit may get; 0.05 (relative) or 1e-5 (paper) when not given.",
             0.0},
            eta);
    v.field({"resolution", "",
             "Residuals below this share of |y| and of the terms count as rounding (relative).",
             0.0, 1.0},
            resolution);
  }
};

/// delMinorTerms: drops the least important term, refits with the pipeline's regressor, and
/// goes on while the fit is acceptable; the term whose loss is not is restored and the rest
/// kept.
class MinorTerms final : public Configured<TermPruner, MinorTermsOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                       const Regressor& regressor, const RunContext& context) const override;
};

}  // namespace lacuna
