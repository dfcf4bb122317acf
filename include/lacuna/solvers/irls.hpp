// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Irls.
struct IrlsOptions {
  /// In which units delta is understood.
  enum class Tolerances {
    Relative,  ///< medians of |residual|: independent of units and of time scale
    Paper,     ///< units of the target, as published
  };

  static constexpr StageInfo kInfo{
      "irls", "Iteratively reweighted least squares: outliers count by size, not by square.",
      "Karimov et al. 2023, eq. (8)"};
  static constexpr std::array<std::string_view, 2> kTolerances{"relative", "paper"};

  Tolerances tolerances = Tolerances::Relative;
  std::optional<double> delta = {};
  double tolerance = 1e-8;
  int max_iterations = 100;

  /// delta, or the default of the chosen tolerances.
  double effective_delta() const {
    return delta.value_or(tolerances == Tolerances::Relative ? 1.0 : 1e-5);
  }

  void describe(OptionVisitor& v) {
    v.field({"tolerances", "",
             "'relative': delta in medians of |residual|; 'paper': in units of the target."},
            kTolerances, tolerances);
    v.field({"delta", "",
             "Residuals up to this have equal weight; 1 (relative) or 1e-5 (paper) when not "
             "given.",
             1e-300},
            delta);
    v.field(
        {"tolerance", "",
         "Ends when no term changes by more than this fraction of the largest.", 1e-15, 1.0},
        tolerance);
    v.field({"max_iterations", "", "Most passes over the rows.", 1.0, 1e6}, max_iterations);
  }
};

/// Iteratively reweighted least squares: minimises sum_i w_i (y_i - E_i h)^2 with the weights
/// (8) of Karimov et al. 2023, w_i = 1 / max(delta, |y_i - E_i h|), started at (7). Its limit
/// minimises the Huber function of the residuals with corner delta; the published delta is raw,
/// the default is one median of |residual|, so that half of the rows count as in least squares.
/// The paper gives no value for delta; 1e-5 is that of its other tolerances.
class Irls final : public Configured<Regressor, IrlsOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
