// SPDX-License-Identifier: MIT
// Least squares in a box that is scaled to the unit cube.
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// When a search by gauss_newton() ends.
struct GaussNewtonSettings {
  double unnoticed = 1e-7;  ///< converged when a step changes |r|^2 by less than this fraction
  int steps = 20;           ///< at most
  double reach = 0.1;      ///< no coordinate moves further in one step
  double wanted = 0.0;     ///< |r|^2 of use: far above it, a search ends where steps gain little
};

/// Whether a sum of squares is so far above what is wanted that only large steps may reach it.
constexpr bool is_far_above(double squares, double wanted) {
  // A fact of the search: nearer the minimum a few small steps may do.
  constexpr double kFar = 4.0;
  return squares > kFar * wanted;
}

/// Where a search has ended.
struct CubeMinimum {
  Vector point;
  double squares = 0.0;    ///< |r|^2 there
  bool converged = false;  ///< else the point is the best so far: no step goes down from it, the
                           ///< residuals do not depend on it, the steps were used up, or what is
                           ///< wanted is out of reach
};

/// Where |r(p)|^2 is least near a starting point in [0,1]^d: steps d with J d = -r, J from
/// differences, halved until the sum falls; what would leave the cube stays on its face. About
/// d + 1 evaluations a step, few steps where r is smooth; on jumps it does not converge. Where a
/// sum of squares is wanted and is_far_above() holds, a step that would not halve what is there
/// ends the search.
/// @param residuals r, K numbers, as many at each point; called with points of the cube only. A
///   sum that is not finite is worse than any.
/// Source: Bjorck, "Numerical Methods for Least Squares Problems", SIAM (1996), section 9.2.
CubeMinimum gauss_newton(FunctionRef<Vector(const Vector&)> residuals, const Vector& start,
                         const GaussNewtonSettings& settings = {});

}  // namespace lacuna
