// SPDX-License-Identifier: MIT
// What the values that are tried as arguments are made of.
#pragma once

#include "arguments/values.hpp"
#include "core/base/random.hpp"

namespace lacuna::arguments {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kHuge = 1e308;
inline constexpr Index kSamples = 40;

/// t, x = (sin 2t, 2 cos 2t), u = sin 3t / 2: what OdeModel's first choice is a model of.
inline Trajectory record() {
  Trajectory record;
  record.source = "made";
  record.time = Vector::LinSpaced(kSamples, 0.0, 3.9);
  record.states.resize(kSamples, 2);
  record.states.col(0) = (2.0 * record.time.array()).sin();
  record.states.col(1) = 2.0 * (2.0 * record.time.array()).cos();
  record.inputs = 0.5 * (3.0 * record.time.array()).sin().matrix();
  return record;
}

inline Dataset dataset(std::vector<Trajectory> records) {
  Dataset data;
  data.states = {{"q", "m"}, {"v", "m/s"}};
  data.inputs = {{"F", "N"}};
  data.trajectories = std::move(records);
  return data;
}

/// The same without inputs and with noise, long enough for everything.
inline Dataset long_record() {
  Dataset data = dataset({record()});
  data.inputs.clear();
  Trajectory& made = data.trajectories.front();
  made.time = Vector::LinSpaced(400, 0.0, 79.8);
  made.states.resize(400, 2);
  Random random(1);
  for (Index i = 0; i < 400; ++i)
    made.states.row(i) << std::sin(2.0 * made.time[i]) + 1e-3 * random.normal(),
        2.0 * std::cos(2.0 * made.time[i]) + 1e-3 * random.normal();
  made.inputs.resize(400, 0);
  return data;
}

template <class Change>
inline Trajectory changed(Change change) {
  Trajectory made = record();
  change(made);
  return made;
}

inline Matrix with(Matrix values, Index i, double value) {
  values(i) = value;
  return values;
}

/// R of [A y] with five columns.
inline Matrix triangle() {
  Matrix values = Matrix::Identity(5, 5);
  for (Index i = 0; i < 5; ++i)
    for (Index j = i + 1; j < 5; ++j)
      values(i, j) = 0.3 * std::sin(static_cast<double>(3 * i + j));
  return values;
}

inline Variables variables() { return {{"q", "v"}, {"F"}}; }

inline OdeModel oscillator() {
  return parse_model(R"({"format": "lacuna.model/1", "time_unit": "s",
    "states": [{"name": "q", "unit": "m"}, {"name": "v", "unit": "m/s"}],
    "inputs": [{"name": "F", "unit": "N"}],
    "equations": [
      {"state": "q", "terms": [{"term": "v", "coefficient": 1.0}]},
      {"state": "v", "terms": [{"term": "q", "coefficient": -4.0},
        {"term": "v", "coefficient": -0.2}, {"term": "F", "coefficient": 1.0}]}]})",
                     "oscillator");
}

/// Without inputs and with an equation that is empty.
inline OdeModel without_inputs() {
  return parse_model(R"({"format": "lacuna.model/1", "time_unit": "s",
    "states": [{"name": "q", "unit": "m"}, {"name": "v", "unit": "m/s"}],
    "equations": [{"state": "q", "terms": [{"term": "v", "coefficient": 1.0}]},
      {"state": "v", "terms": []}]})",
                     "empty");
}

}  // namespace lacuna::arguments
