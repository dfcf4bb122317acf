// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/noisy_records.hpp"
#include "support/one_record.hpp"

namespace lacuna {

/// Lorenz 1996: dx_i/dt = (x_(i+1) - x_(i-2)) x_(i-1) - x_i + 8, indices modulo m.
inline OdeModel lorenz96(Index m) {
  std::vector<Quantity> states;
  Variables variables;
  for (Index i = 0; i < m; ++i) {
    states.push_back({"x" + std::to_string(i), ""});
    variables.states.push_back(states.back().name);
  }
  const auto name = [m](Index i) { return "x" + std::to_string((i + m) % m); };
  std::vector<Equation> equations;
  for (Index i = 0; i < m; ++i)
    equations.push_back({{Term::parse("1", variables), 8.0},
                         {Term::parse(name(i), variables), -1.0},
                         {Term::parse(name(i + 1) + "*" + name(i - 1), variables), 1.0},
                         {Term::parse(name(i - 2) + "*" + name(i - 1), variables), -1.0}});
  return OdeModel(states, {}, equations);
}

/// A record of it, from its attractor, with white noise of a fraction of the rms of each state.
inline Dataset lorenz96_record(Index m, Index samples, double fraction, std::uint64_t seed) {
  constexpr double kStep = 0.01;
  constexpr Index kTransient = 500;
  const OdeModel model = lorenz96(m);
  Vector start = Vector::Constant(m, 8.0);
  for (Index i = 0; i < m; ++i) start[i] += 0.01 * static_cast<double>(i);
  const Solution orbit =
      simulate(model, Dopri8{}, start, sample_times(0.0, kStep, kTransient + samples));
  Random random(seed);
  Trajectory record;
  record.source = "lorenz-96";
  record.time = sample_times(0.0, kStep, samples);
  record.states = orbit.states.bottomRows(samples);
  const Vector sigma = fraction * spread(record.states);
  for (Index k = 0; k < m; ++k)
    for (Index i = 0; i < samples; ++i) record.states(i, k) += sigma[k] * random.normal();
  return support::one_record(model.states(), {}, std::move(record));
}

}  // namespace lacuna
