// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/solvers/selection.hpp"

namespace lacuna {

/// What frols() makes.
class Frols final : public Configured<Regressor, FrolsOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
