// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Ols: none.
struct OlsOptions {
  static constexpr StageInfo kInfo{"ols", "Ordinary least squares.",
                                   "Karimov et al. 2023, eq. (7)"};

  void describe(OptionVisitor&) {}
};

/// Ordinary least squares, h = (E'E)^-1 E'y, (7) of Karimov et al. 2023, from the triangular
/// factor; for Effort::Final followed by one pass of iterative refinement over the rows.
class Ols final : public Configured<Regressor, OlsOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
