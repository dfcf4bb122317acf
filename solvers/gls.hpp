// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/solvers/least_squares.hpp"

namespace lacuna {

/// What gls() makes.
class Gls final : public Configured<Regressor, GlsOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
