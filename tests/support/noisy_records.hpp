// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bases/monomials.hpp"
#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "support/one_record.hpp"

namespace lacuna {

/// Root mean square of each state without its mean.
inline Vector spread(const Matrix& states) {
  const Matrix centred = states.rowwise() - states.colwise().mean();
  return centred.colwise().norm() / std::sqrt(static_cast<double>(states.rows()));
}

/// A record of a test system, 2000 steps from its start, with white noise of a fraction of the
/// spread of each state.
inline Dataset noisy_record(const std::string& name, Index samples, double fraction,
                            std::uint64_t seed) {
  const TestSystem& system = test_system(name);
  const Index transient = 2000;
  const Solution orbit = simulate(system.model, Dopri8{}, system.start,
                                  sample_times(0.0, system.step, transient + samples));
  Random random(seed);
  Trajectory record;
  record.source = name;
  record.time = sample_times(0.0, system.step, samples);
  record.states = orbit.states.bottomRows(samples);
  const Vector sigma = fraction * spread(record.states);
  for (Index k = 0; k < record.states.cols(); ++k)
    for (Index i = 0; i < samples; ++i) record.states(i, k) += sigma[k] * random.normal();
  return support::one_record(system.model.states(), {}, std::move(record));
}

inline TermLibrary quadratic_library(const OdeModel& model) {
  return Monomials{{.max_degree = 2}}.library(model.variables());
}

/// The record without the samples for which `leave_out` says so, cut at gaps as readers do.
inline Dataset cut_at_gaps(const Dataset& data, const std::vector<bool>& leave_out) {
  Dataset result = data;
  result.trajectories.clear();
  const Trajectory& record = data.trajectories[0];
  for (Index i = 0; i < record.samples();) {
    Index end = i;
    while (end < record.samples() && !leave_out[static_cast<std::size_t>(end)]) ++end;
    if (end - i >= 2)
      result.trajectories.push_back({record.source + ", piece " + std::to_string(end),
                                     record.time.segment(i, end - i),
                                     record.states.middleRows(i, end - i),
                                     Matrix(end - i, 0),
                                     {}});
    i = end + 1;
  }
  return result;
}

using Structure = std::set<std::pair<std::size_t, std::string>>;

/// The terms of every equation.
inline Structure structure_of(const OdeModel& model) {
  Structure structure;
  for (std::size_t k = 0; k < model.equations().size(); ++k)
    for (const WeightedTerm& summand : model.equations()[k])
      structure.insert({k, summand.term.name()});
  return structure;
}

}  // namespace lacuna
