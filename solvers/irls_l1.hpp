// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "lacuna/solvers/least_squares.hpp"

namespace lacuna {

/// What irls_l1() makes.
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
