// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "sensitivity_rows.hpp"
#include "window_rates.hpp"

namespace lacuna {

/// What the rounding of an initial state becomes at the samples of its window, in units of
/// sigma: eps sum_j |x_j| |R e_j|, R being the triangle of the sensitivities. Their errors grow
/// like it.
struct GrownRounding {
  double worst = 0.0;     ///< of all windows
  double log_mean = 0.0;  ///< mean of its logarithm over the windows
};

/// The trajectory fit as a linear problem: equations are linearised about a path in phase space
/// instead of about a solution (quasilinearisation; Bellman & Kalaba 1965). In a window of
/// samples
///
///   x' = J (x - path) + Theta(path) h,  J = sum_l h0_l d theta_l / dx,  x(t_0) = s,
///
/// is linear in the initial state s and in the coefficients h of all candidate terms:
/// x = S s + G h + c. Rows are (y - c - S s - G h) / sigma at the samples. Samples enter as
/// they were measured, so that residuals are white where the model is right, and noise in terms
/// does not bias h. Initial states are eliminated window by window. With the x found as the
/// next path, h0 = h, the iteration is Newton's for the nonlinear problem; as it begins with
/// the smoothed samples, it needs no model that can be simulated: h0 = 0 will do.
///
/// S, G, c are integrated by the Runge-Kutta method of order 4, whose maps over a step are the
/// same for all columns (LinearStep, b = Theta h - J path).
struct Linearisation {
  Matrix h0;  ///< m x L
  std::vector<Coefficient> columns;
  Matrix triangle;            ///< R of the rows [G | y - c], q + 1 columns
  Index rows = 0;             ///< white rows
  std::vector<Matrix> heads;  ///< of each window, m x (m + q + 1): what determines s
  GrownRounding rounding;
};

/// Where and in what is linearised.
struct LinearisationPoint {
  const Matrix& h0;  ///< m x L
  const std::vector<Coefficient>& columns;
};

/// Linearises about the path.
/// @param rates of the equations.
/// @param folding Gram: tried first where there are many columns; becomes Orthogonal when it
///   could not resolve them.
Linearisation linearise(WindowRates& rates, const WindowedPath& path,
                        const LinearisationPoint& point, Folding& folding,
                        const RunContext& context);

}  // namespace lacuna
