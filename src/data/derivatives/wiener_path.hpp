// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Samples of signals whose m-th derivative is white noise; see KalmanSmoother.
struct WienerPath {
  std::vector<Matrix> states;      ///< by order of the derivative 0..m-1, n x columns
  std::vector<Vector> deviations;  ///< of them, n, where the samples' noise is 1
  Vector noise;                    ///< of each column's samples, by likelihood
};

/// The smoothed path. @param order m = 2, 3, 4; @param lambda noise variance over intensity.
/// @throws ArgumentError for other orders, lambda <= 0 or shapes that do not fit.
WienerPath smooth_wiener(const Vector& time, const Matrix& values, int order, double lambda);

/// -2 log likelihood of the samples from the ninth on given those before, with the noise of each
/// column profiled out. @throws ArgumentError as smooth_wiener(), and for fewer than ten.
double wiener_score(const Vector& time, const Matrix& values, int order, double lambda);

}  // namespace lacuna
