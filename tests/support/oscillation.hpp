// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// n samples of x = sin(2 t), v = 2 cos(2 t) from t = `start`, `step` apart; input u = t^2.
inline Trajectory oscillation(Index n, double start = 0.0, double step = 0.01) {
  Trajectory record;
  record.source = "run.csv";
  record.time = Vector::LinSpaced(n, start, start + step * static_cast<double>(n - 1));
  record.states.resize(n, 2);
  record.states << (2.0 * record.time.array()).sin(), 2.0 * (2.0 * record.time.array()).cos();
  record.inputs = record.time.cwiseAbs2();
  return record;
}

inline Dataset oscillation_data(Index n = 400) {
  Dataset data;
  data.states = {{"x", "m"}, {"v", "m/s"}};
  data.inputs = {{"u", "N"}};
  data.trajectories = {oscillation(n)};
  return data;
}

/// dx/dt = v, dv/dt = -4 x, exactly.
inline void give_derivatives(Trajectory& record) {
  record.derivatives.resize(record.samples(), 2);
  record.derivatives << record.states.col(1), -4.0 * record.states.col(0);
}

}  // namespace lacuna
