// SPDX-License-Identifier: MIT
// Records of models of which only outputs are measured.
#pragma once

#include <cmath>
#include <string>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "dynamics/integration/butcher_tableau.hpp"
#include "dynamics/integration/cvode.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "model/equations/output_values.hpp"

namespace lacuna::support {

/// How a grey box is recorded.
struct GreyBoxRecord {
  Vector start;  ///< m
  double step = 0.05;
  Index samples = 600;
  double noise = 0.01;  ///< of the standard deviation of each output
  std::uint64_t seed = 1;
  bool exact = false;  ///< whether it is solved by CVODE, else by one step for each sample
};

/// Inputs that move everything: sums of three sines about 1.
inline Matrix grey_box_inputs(const Vector& time, Index count) {
  Matrix inputs(time.size(), count);
  for (Index j = 0; j < count; ++j) {
    const double w = 0.7 + 0.31 * static_cast<double>(j);
    inputs.col(j) = 1.0 + 0.5 * (w * time.array()).sin() +
                    0.3 * (2.7 * w * time.array()).sin() + 0.2 * (7.3 * w * time.array()).cos();
  }
  return inputs;
}

/// What was measured of a model: its outputs with noise, in a dataset of columns.
inline Dataset grey_box_columns(const OdeModel& model, const GreyBoxRecord& record) {
  const Vector time = sample_times(0.0, record.step, record.samples);
  const Matrix inputs = grey_box_inputs(time, static_cast<Index>(model.inputs().size()));
  RecordInput signal(time, inputs, Interpolation::Linear);
  const DrivenModel driven{model, signal, signal.breaks()};
  const Solution orbit = record.exact ? simulate(driven, Cvode(), record.start, time)
                                      : simulate(driven, Rk4{}, record.start, time);
  Dataset data;
  data.time_unit = model.time_unit();
  data.inputs = model.inputs();
  Trajectory run{"record", time, output_values(model, time, orbit.states, inputs), inputs,
                 Matrix()};
  Random random(record.seed);
  for (Index c = 0; c < run.states.cols(); ++c) {
    data.states.push_back({model.outputs()[static_cast<std::size_t>(c)].name, ""});
    const Vector y = run.states.col(c);
    const double deviation = record.noise * std::sqrt((y.array() - y.mean()).square().mean());
    for (double& value : run.states.col(c)) value += deviation * random.normal();
  }
  data.trajectories = {std::move(run)};
  return data;
}

/// The same as a model sees it.
inline Dataset grey_box(const OdeModel& model, const GreyBoxRecord& record) {
  return model_view(model, grey_box_columns(model, record), FiniteDifferences{});
}

}  // namespace lacuna::support
