// SPDX-License-Identifier: MIT
// Records of a driven oscillator with something in it that its nominal model (oscillator() of
// diagnosis_scope.hpp) does not have.
#pragma once

#include <cmath>
#include <functional>

#include "core/base/random.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna::support {

/// What is hidden: added to dv/dt.
using Hidden = std::function<double(double t, double q, double v)>;

/// 1501 samples of 30 s of q' = v, v' = -4 q - 0.2 v + F + hidden, Runge-Kutta steps of 2 ms, F
/// a sum of three sines, with white noise of the given deviation on q and v.
inline Dataset hidden_record(const Hidden& hidden, double noise, std::uint64_t seed = 3,
                             double start = 0.5) {
  Dataset data = oscillator_record();
  Trajectory& record = data.trajectories.front();
  constexpr Index kSamples = 1501;
  constexpr int kParts = 10;
  const auto force = [](double t) {
    return std::sin(1.7 * t) + 0.7 * std::sin(2.9 * t + 1.0) + 0.5 * std::sin(0.6 * t);
  };
  const auto rate = [&](double t, double q, double v) {
    return -4.0 * q - 0.2 * v + force(t) + hidden(t, q, v);
  };
  record.time = Vector::LinSpaced(kSamples, 0.0, 30.0);
  record.states.resize(kSamples, 2);
  record.inputs.resize(kSamples, 1);
  Random random(seed);
  double q = start, v = 0.0;
  for (Index i = 0; i < kSamples; ++i) {
    const double t = record.time[i];
    record.states(i, 0) = q + noise * random.normal();
    record.states(i, 1) = v + 2.0 * noise * random.normal();
    record.inputs(i, 0) = force(t);
    const double h = 0.02 / kParts;
    for (int part = 0; part < kParts; ++part) {
      const double s = t + h * part;
      const double a1 = rate(s, q, v), v1 = v;
      const double v2 = v + 0.5 * h * a1, a2 = rate(s + 0.5 * h, q + 0.5 * h * v1, v2);
      const double v3 = v + 0.5 * h * a2, a3 = rate(s + 0.5 * h, q + 0.5 * h * v2, v3);
      const double v4 = v + h * a3, a4 = rate(s + h, q + h * v3, v4);
      q += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
      v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
  }
  return data;
}

inline double nothing(double, double, double) { return 0.0; }

}  // namespace lacuna::support
