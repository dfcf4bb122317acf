// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// n times from 0 to `end`, equally spaced.
inline Vector uniform_grid(Index n, double end) { return Vector::LinSpaced(n, 0.0, end); }

/// The same with every inner time moved by up to 0.3 steps.
inline Vector jittered_grid(Index n, double end, std::uint64_t seed = 7) {
  Random random(seed);
  Vector time = uniform_grid(n, end);
  const double step = end / static_cast<double>(n - 1);
  for (Index i = 1; i + 1 < n; ++i) time[i] += random.uniform(-0.3, 0.3) * step;
  return time;
}

/// sum_p t^p, p = 0..degree, or its k-th derivative.
inline Vector polynomial(const Vector& time, int degree, int derivative = 0) {
  Vector result = Vector::Zero(time.size());
  for (int p = derivative; p <= degree; ++p) {
    double factor = 1.0;
    for (int q = p - derivative + 1; q <= p; ++q) factor *= q;
    result.array() += factor * time.array().pow(p - derivative);
  }
  return result;
}

/// Largest error of a derivative relative to the largest value.
inline double relative_error(const Vector& found, const Vector& expected) {
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

}  // namespace lacuna
