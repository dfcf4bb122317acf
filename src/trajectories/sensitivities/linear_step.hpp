// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// The maps of one step of the Runge-Kutta method of order 4 for x' = J x + b:
///   x_1 = whole x_0 + first b_0 + middle b_m + h/6 b_1.
struct LinearStep {
  Matrix whole, first, middle;  ///< m x m
  double last = 0.0;            ///< h / 6

  /// @param dimension m; @param length h.
  /// @param jacobians three columns of m m entries: at the begin, the middle and the end.
  void compute(const Eigen::Ref<const Matrix>& jacobians, Index dimension, double length);
};

}  // namespace lacuna
