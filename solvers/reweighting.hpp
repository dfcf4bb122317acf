// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// How reweighting goes on and when it ends.
struct ReweightingRule {
  bool relative = true;      ///< delta in medians of |residual|, weights at most 1; else raw
  double delta = 1.0;        ///< residuals up to this have equal weight
  double tolerance = 1e-8;   ///< largest change of |h_j||theta_j| relative to the largest term
  int max_iterations = 100;  ///< passes over the rows
};

/// Where reweighting ended.
struct ReweightingOutcome {
  Vector coefficients;     ///< h, one per active term
  bool converged = false;  ///< whether the coefficients settled
  int iterations = 0;
};

/// Solves a weighted problem, given the coefficients so far and the weights as a function of
/// residuals.
using WeightedSolve = FunctionRef<Vector(const Subproblem& weighted, const Vector& h,
                                         const WeightFunction& weights)>;

/// Iteratively reweighted fitting from the least-squares solution (7) on: after each solution
/// rows get the weights w_i = 1 / max(delta, |y_i - E_i h|), (8) of Karimov et al. 2023.
///
/// Relative rule: delta is measured in medians of |y_i - E_i h|; the median may only fall from
/// one iteration to the next, so that every iteration lowers one and the same Huber function
/// and gross errors in the start are forgotten; the weights are multiplied by delta (at most 1,
/// without unit). Residuals below 1e-13 of the target's root mean square count as that.
ReweightingOutcome reweight(const LeastSquaresSystem& system, const Subproblem& problem,
                            const ReweightingRule& rule, WeightedSolve solve,
                            const RunContext& context);

}  // namespace lacuna
