// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna::testing {

/// An orbit on the attractor of the Rossler system with exact derivatives:
///   x' = -y - z,  y' = x + 0.2 y,  z' = 0.2 + z (x - 5.7).
struct RosslerData {
  Vector time;         ///< n, starts at 0
  Matrix states;       ///< n x 3: x, y, z
  Matrix derivatives;  ///< n x 3: the right-hand side at the states
};

/// Right-hand side of the Rossler system.
inline Eigen::Vector3d rossler_rate(const Eigen::Vector3d& s) {
  constexpr double kA = 0.2;
  constexpr double kB = 0.2;
  constexpr double kC = 5.7;
  return {-s[1] - s[2], s[0] + kA * s[1], kB + s[2] * (s[0] - kC)};
}

/// One step of the classical Runge-Kutta method of order 4.
inline Eigen::Vector3d rossler_step(const Eigen::Vector3d& s, double h) {
  const Eigen::Vector3d k1 = rossler_rate(s);
  const Eigen::Vector3d k2 = rossler_rate(s + 0.5 * h * k1);
  const Eigen::Vector3d k3 = rossler_rate(s + 0.5 * h * k2);
  const Eigen::Vector3d k4 = rossler_rate(s + h * k3);
  return s + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

/// n samples, h apart, after a transient of 200 units of time. Steps of at most 0.002 between
/// samples keep the error of the orbit within a sample below 1e-13.
inline RosslerData make_rossler_data(Index n, double h) {
  constexpr double kLongestStep = 0.002;
  constexpr int kTransientSteps = 100000;
  const int substeps = static_cast<int>(h / kLongestStep) + 1;
  RosslerData data{Vector(n), Matrix(n, 3), Matrix(n, 3)};
  Eigen::Vector3d state(1.0, 1.0, 0.0);
  for (int i = 0; i < kTransientSteps; ++i) state = rossler_step(state, kLongestStep);
  for (Index row = 0; row < n; ++row) {
    data.time[row] = h * static_cast<double>(row);
    data.states.row(row) = state.transpose();
    data.derivatives.row(row) = rossler_rate(state).transpose();
    for (int i = 0; i < substeps; ++i) state = rossler_step(state, h / substeps);
  }
  return data;
}

}  // namespace lacuna::testing
