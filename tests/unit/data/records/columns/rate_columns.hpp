// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna::testing {

/// dx/dt of a system.
using Rates = std::function<Vector(double t, const Vector& x)>;

/// States of a system at n samples, and their derivatives beside them, by Runge-Kutta steps.
inline Trajectory states_and_rates(const Rates& rates, Vector x, Index n, double step) {
  Trajectory record;
  record.source = "run.csv";
  record.time = Vector::LinSpaced(n, 0.0, step * static_cast<double>(n - 1));
  record.states.resize(n, 2 * x.size());
  record.inputs.resize(n, 0);
  for (Index i = 0; i < n; ++i) {
    const double t = record.time[i];
    const Vector k1 = rates(t, x);
    record.states.row(i) << x.transpose(), k1.transpose();
    const Vector k2 = rates(t + step / 2, x + step / 2 * k1);
    const Vector k3 = rates(t + step / 2, x + step / 2 * k2);
    x += step / 6 * (k1 + 2 * k2 + 2 * k3 + rates(t + step, x + step * k3));
  }
  return record;
}

/// Some of the columns with names, and white noise of a fraction of their deviations.
inline Dataset named_columns(std::vector<Trajectory> records, const std::vector<Index>& columns,
                             const std::vector<std::string>& names, double fraction = 0.0,
                             std::uint64_t seed = 1) {
  Dataset data;
  Random random(seed);
  for (const std::string& name : names) data.states.push_back({name, ""});
  for (Trajectory& record : records) {
    record.states = record.states(Eigen::all, columns).eval();
    for (auto column : record.states.colwise()) {
      const double mean = column.mean();
      const double deviation =
          std::sqrt((column.array() - mean).square().mean()) * fraction;
      for (double& value : column) value += deviation * random.normal();
    }
    data.trajectories.push_back(std::move(record));
  }
  return data;
}

/// Predator and prey: a cycle.
inline Vector lotka_volterra(double, const Vector& x) {
  return Vector{{x[0] * (1.0 - x[1]), x[1] * (x[0] - 1.0)}};
}

/// A pendulum with friction: angle and velocity.
inline Vector pendulum(double, const Vector& x) {
  return Vector{{x[1], -4.0 * std::sin(x[0]) - 0.1 * x[1]}};
}

inline double drive(double t) { return 0.5 * std::sin(1.7 * t) + 0.5 * std::sin(0.61 * t); }

/// An oscillator that two tones drive.
inline Vector driven(double t, const Vector& x) {
  return Vector{{x[1], -x[0] - 0.3 * x[1] + drive(t)}};
}

/// Two positions and two velocities (Henon and Heiles).
inline Vector two_masses(double, const Vector& x) {
  return Vector{
      {x[2], x[3], -x[0] - 2.0 * x[0] * x[1], -x[1] - x[0] * x[0] + x[1] * x[1]}};
}

inline Vector lorenz(double, const Vector& x) {
  return Vector{{10.0 * (x[1] - x[0]), x[0] * (28.0 - x[2]) - x[1],
                 x[0] * x[1] - 8.0 / 3.0 * x[2]}};
}

}  // namespace lacuna::testing
