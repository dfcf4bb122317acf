// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/l1_solver.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of IrlsL1; the inner solver has no default.
struct IrlsL1Options {
  /// In which units delta and alpha are understood.
  enum class Tolerances {
    Relative,  ///< independent of n, of units and of time scale
    Paper,     ///< raw, as published
  };

  static constexpr StageInfo kInfo{
      "irls-l1", "Iteratively reweighted least squares with an l1 penalty on the coefficients.",
      "Karimov et al. 2023, Sect. 2.1, eq. (8)"};
  static constexpr std::array<std::string_view, 2> kTolerances{"relative", "paper"};

  Stage<L1Solver> inner;
  double alpha = 1e-6;
  Tolerances tolerances = Tolerances::Relative;
  std::optional<double> delta = {};
  double tolerance = 1e-8;
  int max_iterations = 100;

  /// delta, or the default of the chosen tolerances.
  double effective_delta() const {
    return delta.value_or(tolerances == Tolerances::Relative ? 1.0 : 1e-5);
  }

  void describe(OptionVisitor& v) {
    v.field({"inner", "", "Solves the penalised problem for given weights."}, inner);
    v.field({"alpha", "",
             "Penalty; 'relative': as a fraction of the penalty that leaves no term.", 0.0},
            alpha);
    v.field(
        {"tolerances", "",
         "'relative': delta in medians of |residual|, alpha without unit; 'paper': both raw."},
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

/// l1-regularised IRLS: minimises sum_i w_i (y_i - E_i h)^2 + alpha |h|_1 started at (7), with
/// weights (8) of Karimov et al. 2023 after each iteration; the inner problem goes to an
/// L1Solver in triangular form with columns scaled to unit norm, z_j = h_j |sqrt(W) e_j|.
///
/// Paper tolerances: alpha multiplies |h_j| as printed, so it depends on n, units and time
/// scale. Relative ones: |h_j| |e_j| has the penalty alpha * 2 max_j |e_j' W y| / |e_j| with
/// the weights W of the residuals y, which is the smallest that leaves no term for the present
/// delta: alpha = 1 leaves none, whatever n and the units are. For given delta the problem is
/// convex and every iteration lowers the objective. Terms whose coefficient is zero leave the
/// active set and are reported.
class IrlsL1 final : public Configured<Regressor, IrlsL1Options> {
 public:
  /// @throws ConfigError when an option is out of its range.
  explicit IrlsL1(IrlsL1Options options) : Configured(std::move(options)) {}

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;

  /// Penalty on every |h_j|.
  Vector penalties(const LeastSquaresSystem& system, const Subproblem& problem,
                   const WeightFunction& weights, const RunContext& context) const;
};

}  // namespace lacuna
