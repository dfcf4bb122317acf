// SPDX-License-Identifier: MIT
// The joint least-squares problem of coefficients and shapes of effects.
#pragma once

#include <utility>
#include <vector>

#include "lacuna/diagnose/candidates/explanation.hpp"

namespace lacuna {

/// A Gauss-Newton step of all shapes, with all that is fitted besides.
struct ShapeStep {
  std::vector<std::pair<std::size_t, Index>> places = {};  ///< effect and shape
  Vector step = {}, deviation = {};                        ///< one entry each
  double promised = 0.0;                                   ///< drop of the deviance by the step
  Matrix covariance = {};  ///< as Assimilation::covariance, whatever the shapes are
};

/// The step from an explanation. A shape at which its form does not move is left out; no places
/// where none is left.
/// @param options those of the fit.
ShapeStep shape_step(const Explanation& at, const AssimilationOptions& options);

}  // namespace lacuna
