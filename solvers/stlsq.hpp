// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/solvers/selection.hpp"

namespace lacuna {

/// What stlsq() makes.
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
