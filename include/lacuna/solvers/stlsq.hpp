// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Stlsq.
struct StlsqOptions {
  /// What is compared with the threshold.
  enum class Scale {
    Contribution,  ///< |h_j| |theta_j| / |y|: without unit
    Coefficient,   ///< |h_j| in the units of the data
  };

  static constexpr StageInfo kInfo{
      "stlsq", "Least squares with all small terms removed, again and again.",
      "Brunton, Proctor & Kutz, PNAS 113 (2016) 3932"};
  static constexpr std::array<std::string_view, 2> kScales{"contribution", "coefficient"};

  double threshold = 0.01;
  Scale scale = Scale::Contribution;
  std::optional<double> alpha = {};
  int max_iterations = 100;

  void describe(OptionVisitor& v) {
    v.field({"threshold", "", "Smaller terms are removed.", 0.0}, threshold);
    v.field({"scale", "",
             "'contribution': |h_j| |theta_j| / |y|; 'coefficient': |h_j|, depends on units."},
            kScales, scale);
    v.field({"alpha", "",
             "Ridge penalty on the squares of what 'scale' names (times |y|), while terms are "
             "chosen; none when not given.",
             0.0},
            alpha);
    v.field({"max_iterations", "", "Most rounds of removal.", 1.0, 1e6}, max_iterations);
  }
};

/// Sequentially thresholded least squares: fit, remove every term below the threshold, fit
/// again until none is below. With a ridge penalty the terms are chosen on
///   |y - Theta h|^2 + alpha |D h|^2, D = diag |theta_j| (contribution) or identity
///   (coefficient);
/// the coefficients returned are those of plain least squares on the chosen terms.
/// Regression::removed says which term went in which round and at which number.
/// Source: Brunton, Proctor & Kutz 2016, supporting code; `coefficient` as PySINDy has it.
class Stlsq final : public Configured<Regressor, StlsqOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;

  /// What is compared with the threshold, one number per active term.
  Vector measures(const Subproblem& problem) const;
};

}  // namespace lacuna
