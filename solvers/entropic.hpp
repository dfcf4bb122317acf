// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/solvers/selection.hpp"

namespace lacuna {

/// What entropic() makes.
class Entropic final : public Configured<Regressor, EntropicOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
