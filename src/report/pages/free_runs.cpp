// SPDX-License-Identifier: MIT
#include "free_runs.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/data/records/marks.hpp"
#include "trajectories/windows/window_paths.hpp"

namespace lacuna {
namespace {

constexpr Index kShortest = 20;    // samples of a window
constexpr Index kLongest = 60000;  // samples of a record that are looked at: a picture shows
                                   // the difference of no more

/// Samples between upward crossings of the mean, the fewest of all states.
Index mean_period(const Matrix& states) {
  Index shortest = states.rows();
  for (Index k = 0; k < states.cols(); ++k) {
    const double mean = states.col(k).mean();
    Index crossings = 0;
    for (Index i = 1; i < states.rows(); ++i)
      if (states(i - 1, k) < mean && states(i, k) >= mean) ++crossings;
    if (crossings > 1) shortest = std::min(shortest, states.rows() / crossings);
  }
  return std::clamp(shortest, std::min(kShortest, states.rows()), states.rows());
}

/// White noise of each state; where none is known, what is small against its spread.
NoiseModel noise_of(const Matrix& states, const Vector& noise) {
  NoiseModel model;
  model.disturbance = Vector::Zero(states.cols());
  const Vector spread = column_deviations({states});
  for (Index k = 0; k < states.cols(); ++k) {
    const bool known = k < noise.size() && noise[k] > 0.0;
    model.measurement.emplace_back(known ? noise[k] : 1e-3 * spread[k]);
    model.coloured.emplace_back();
  }
  return model;
}

/// The paths in windows, by Newton's method: each pass linearises along the path of the last.
Matrix paths_of(const OdeModel& model, const Trajectory& record, const NoiseModel& noise,
                Index length) {
  constexpr int kPasses = 4;
  const Vector accuracy = 1e-4 * column_deviations({record.states});
  Matrix path = record.states;
  const Matrix marks = marks_of(record);
  for (int pass = 0; pass < kPasses; ++pass) {
    const LinearisedRecord linear = linearise(model, record, path, accuracy);
    const Matrix next = window_paths(linear, {record.states, marks}, noise, {0, length});
    // Where a window has no finite solution the record stands for it in the next pass.
    path = next.array().isFinite().select(next, record.states);
    if (pass + 1 == kPasses) return next;
  }
  return path;
}

}  // namespace

std::vector<GapRecord> free_runs(const OdeModel& model, const Dataset& data,
                                 const Vector& noise) {
  std::vector<GapRecord> runs;
  for (const Trajectory& whole : data.trajectories) {
    if (whole.samples() < kShortest) continue;
    const Trajectory record = rows_of(whole, 0, std::min(whole.samples(), kLongest));
    const Index length = mean_period(record.states);
    const Matrix after = paths_of(model, record, noise_of(record.states, noise), length);
    if (!after.array().isFinite().any()) continue;
    runs.push_back({whole.source, record.time, record.states, Matrix(), after, 0, length});
  }
  return runs;
}

}  // namespace lacuna
