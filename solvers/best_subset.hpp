// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/solvers/selection.hpp"

namespace lacuna {

/// What best_subset() makes.
class BestSubset final : public Configured<Regressor, BestSubsetOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
