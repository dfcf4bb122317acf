// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Gls.
struct GlsOptions {
  static constexpr StageInfo kInfo{
      "gls", "Generalised least squares: residuals of neighbouring rows may be alike.",
      "Aitken, Proc. R. Soc. Edinburgh 55 (1935) 42; Cochrane & Orcutt, J. Am. Stat. Assoc. 44 "
      "(1949) 32; Prais & Winsten, Cowles Commission 383 (1954)"};

  int max_iterations = 50;

  void describe(OptionVisitor& v) {
    v.field({"max_iterations", "", "Most rounds.", 1.0, 1e6}, max_iterations);
  }
};

/// Generalised least squares with residuals of an autoregressive process of order 1:
///
///   min_h (y - Theta h)' V^-1 (y - Theta h),  V_ij = rho^|i-j|,
///
/// rho = sum_i r_i r_{i-1} / sum_i r_i^2 of the residuals r at the last h, beginning with least
/// squares, until rho no longer changes. Rows are whitened, e_i - rho e_{i-1}, the first by
/// sqrt(1 - rho^2); successive rows are taken for neighbours, ends of records included.
class Gls final : public Configured<Regressor, GlsOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
