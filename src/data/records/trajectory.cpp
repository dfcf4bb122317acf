// SPDX-License-Identifier: MIT
#include "lacuna/data/records/trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {

double mean_step(const Trajectory& trajectory) {
  return trajectory.duration() / static_cast<double>(trajectory.samples() - 1);
}

std::optional<double> uniform_step(const Trajectory& trajectory, double tolerance) {
  const Vector& time = trajectory.time;
  if (time.size() < 2) return std::nullopt;
  const double mean = mean_step(trajectory);
  const auto steps = (time.tail(time.size() - 1) - time.head(time.size() - 1)).array();
  const bool uniform = ((steps - mean).abs() <= tolerance * std::abs(mean)).all();
  return uniform ? std::optional<double>(mean) : std::nullopt;
}

Trajectory rows_of(const Trajectory& trajectory, Index first, Index count) {
  const auto part = [&](const Matrix& values) -> Matrix {
    if (values.rows() == 0) return Matrix(0, 0);
    return values.middleRows(first, count);
  };
  return {
      trajectory.source,       trajectory.time.segment(first, count), part(trajectory.states),
      part(trajectory.inputs), part(trajectory.derivatives),          part(trajectory.marks)};
}

std::string file_of(const Trajectory& trajectory) {
  return trajectory.source.substr(0, trajectory.source.rfind(", record "));
}

bool goes_on(const Trajectory& before, const Trajectory& after, double longest_gap) {
  const double gap = after.time[0] - before.time[before.samples() - 1];
  return file_of(before) == file_of(after) && gap > 0.0 && gap <= longest_gap;
}

}  // namespace lacuna
