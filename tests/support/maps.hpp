// SPDX-License-Identifier: MIT
// Orbits of maps, iterated by hand.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna::testing {

using MapFunction = std::function<Vector(const Vector&)>;

struct MapNoise {
  double disturbance = 0.0;  ///< added to each state in each step
  double measured = 0.0;     ///< added to the samples
  std::uint64_t seed = 1;
};

/// x[0], f(x[0]), ... as a record with a step of 1.
inline Dataset orbit_of_map(const MapFunction& map, const Vector& start, Index samples,
                            const MapNoise& noise = {}) {
  Random random(noise.seed);
  const Index m = start.size();
  Dataset data;
  for (Index k = 0; k < m; ++k)
    data.states.push_back({std::string(1, char((m > 3 ? 'a' : 'x') + k)), ""});
  Trajectory record{"orbit", Vector::LinSpaced(samples, 0.0, double(samples - 1)),
                    Matrix(samples, m), Matrix(samples, 0), Matrix()};
  Vector x = start;
  for (Index i = 0; i < samples; ++i) {
    for (Index k = 0; k < m; ++k) record.states(i, k) = x[k] + noise.measured * random.normal();
    x = map(x);
    for (Index k = 0; k < m; ++k) x[k] += noise.disturbance * random.normal();
  }
  data.trajectories.push_back(std::move(record));
  return data;
}

/// Henon's map, 1976.
inline Vector henon(const Vector& x) {
  return Vector{{1.0 - 1.4 * x[0] * x[0] + x[1], 0.3 * x[0]}};
}

/// The logistic map at 3.9.
inline Vector logistic(const Vector& x) { return Vector{{3.9 * x[0] * (1.0 - x[0])}}; }

/// Two logistic maps of different rates, each of which gets a fraction of the other's.
inline Vector coupled_logistic(const Vector& x) {
  const double f = 3.7 * x[0] * (1.0 - x[0]), g = 3.8 * x[1] * (1.0 - x[1]);
  return Vector{{0.95 * f + 0.05 * g, 0.9 * g + 0.1 * f}};
}

/// The Tinkerbell map: quadratic, turning and stretching as Ikeda's does.
inline Vector tinkerbell(const Vector& x) {
  return Vector{{x[0] * x[0] - x[1] * x[1] + 0.9 * x[0] - 0.6013 * x[1],
                 2.0 * x[0] * x[1] + 2.0 * x[0] + 0.5 * x[1]}};
}

/// The Burgers map (Whitehead and Macdonald, Physica D 13 (1984) 401), which bears noise.
inline Vector burgers(const Vector& x) {
  return Vector{{0.75 * x[0] - x[1] * x[1], 1.75 * x[1] + x[0] * x[1]}};
}

}  // namespace lacuna::testing
