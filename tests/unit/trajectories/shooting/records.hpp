// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/equations/system_model.hpp"

namespace lacuna::testing {

/// A clean record of a test system with its usual step.
inline Dataset clean_record(const OdeModel& model, const TestSystem& system, Index n) {
  return record_of(model, Dopri8{Dopri8Options{.substeps = 4}}, system.start, system.step, n);
}

inline Dataset noisy_record(const std::string& name, Index n, double noise,
                            std::uint64_t seed = 1) {
  const TestSystem& system = test_system(name);
  return add_relative_noise(clean_record(system.model, system, n), noise, seed);
}

/// The parametrisation with values off by so much, alternately up and down.
inline ParametrisedModel perturbed(const ParametrisedModel& model, double fraction) {
  Vector values = model.values();
  for (Index i = 0; i < values.size(); ++i)
    values[i] *= 1.0 + (i % 2 == 0 ? fraction : -fraction);
  return model.with_values(values);
}

/// A record of states without a column.
inline Dataset without_states(Dataset data, Index first, Index count) {
  const auto begin = data.states.begin() + first;
  data.states.erase(begin, begin + count);
  for (Trajectory& run : data.trajectories) {
    const Matrix all = run.states;
    run.states.resize(all.rows(), all.cols() - count);
    run.states << all.leftCols(first), all.rightCols(all.cols() - first - count);
    run.derivatives.resize(0, 0);
  }
  return data;
}

}  // namespace lacuna::testing
