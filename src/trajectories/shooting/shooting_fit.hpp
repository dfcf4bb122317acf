// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/run_context.hpp"
#include "shooting_problem.hpp"

namespace lacuna {

/// Windows with the best parameters and initial states found for them.
struct ShootingFit {
  WindowPlan plan;
  ShootingPoint point;
  ShootingLinearisation linear;  ///< at the point
  bool converged = false;
  int iterations = 0;
};

/// minimise_blocks() or minimise_blocks_by_ceres().
using Minimiser = BlockMinimum (*)(BlockProblem&, BlockPoint, const BlockTask&,
                                   const RunContext&);

/// Minimises the cost for fixed windows, from the plan and the point of `fit` (its parameters
/// and starts) on; a window that diverges makes it infinite.
/// @param tolerance decrease of cost that is not worth a step, relative to the cost per degree
///   of freedom: a decrease of 1 moves a parameter by one standard error.
void minimise(ShootingProblem& problem, ShootingFit& fit, double tolerance, int max_iterations,
              const RunContext& context, Minimiser minimiser = minimise_blocks);

/// Residuals less parameters and initial states; at least 1.
Index degrees_of_freedom(const ShootingProblem& problem, const WindowPlan& plan);

/// The noise of each measured state from its residuals in a fit: root mean square with
/// `taken` degrees of freedom taken away from each, or, robustly, from the median.
/// @param taken per measured state; when empty, shared out evenly.
Vector residual_sigma(const ShootingProblem& problem, const ShootingFit& fit, bool robust,
                      const Vector& taken = {});

/// Initial states of windows: the states at their first samples.
Matrix starts_of(const WindowPlan& plan, const Matrix& states);

/// The first scheme on a ladder of methods and substeps whose error,
/// found by comparison with the next one, does not matter beside the noise: |error / sigma| <=
/// 0.1 over all samples together, or which is not surpassed by the next two.
/// @param sigma noise to hold the error against.
StepScheme accurate_scheme(ShootingProblem& problem, const WindowPlan& plan,
                           const ShootingPoint& point, const Vector& sigma);

}  // namespace lacuna
