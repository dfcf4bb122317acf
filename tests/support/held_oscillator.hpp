// SPDX-License-Identifier: MIT
// Records of q' = v, v' = -4 q - 0.2 v + F whose force is not smooth between samples.
#pragma once

#include <cmath>
#include <functional>

#include "core/base/random.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna::support {

/// The force from sample i to the next one: levels that change at every fifth sample; where it
/// switches it does so a fraction of a step after that sample.
struct HeldForce {
  Hold hold = Hold::Zero;
  Vector levels;     ///< at the samples
  Vector fractions;  ///< of steps

  double at(Index i, double fraction) const {
    const double from = levels[i], to = levels[i + 1];
    if (hold == Hold::Zero) return from;
    if (hold == Hold::Linear) return from + fraction * (to - from);
    return fraction < fractions[i] ? from : to;
  }
};

inline HeldForce held_force(Hold hold, Index samples, std::uint64_t seed) {
  HeldForce force{hold, Vector(samples), Vector(samples)};
  Random random(seed);
  for (Index i = 0; i < samples; ++i) {
    const double level = random.normal();
    force.levels[i] = i % 5 == 0 ? level : force.levels[i - 1];
    force.fractions[i] = std::abs(std::fmod(1.7 * random.normal(), 1.0));
  }
  return force;
}

/// 1001 samples of 20 s with white noise of the given deviation, by 64 midpoint steps of the
/// exact linear motion a sample: the force is constant in each or jumps at its middle at worst.
/// @param hidden is added to dv/dt.
inline Dataset held_record(Hold hold, double noise, std::uint64_t seed = 5,
                           const std::function<double(double)>& hidden = {}) {
  constexpr Index kSamples = 1001;
  constexpr int kParts = 64;
  Dataset data = oscillator_record();
  Trajectory& record = data.trajectories.front();
  const HeldForce force = held_force(hold, kSamples, seed);
  record.time = Vector::LinSpaced(kSamples, 0.0, 20.0);
  record.states.resize(kSamples, 2);
  record.inputs = force.levels;
  Random random(seed + 1);
  double q = 0.5, v = 0.0;
  for (Index i = 0; i < kSamples; ++i) {
    record.states(i, 0) = q + noise * random.normal();
    record.states(i, 1) = v + 2.0 * noise * random.normal();
    if (i + 1 == kSamples) break;
    const double h = 0.02 / kParts;
    for (int part = 0; part < kParts; ++part) {
      const double f = force.at(i, (part + 0.5) / kParts);
      const auto rate = [&](double q0, double v0) {
        return -4.0 * q0 - 0.2 * v0 + f + (hidden ? hidden(v0) : 0.0);
      };
      const double qm = q + 0.5 * h * v, vm = v + 0.5 * h * rate(q, v);
      q += h * vm;
      v += h * rate(qm, vm);
    }
  }
  return data;
}

}  // namespace lacuna::support
