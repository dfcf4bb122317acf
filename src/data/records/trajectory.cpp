// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "data/records/check_record.hpp"
#include "data/records/piece_name.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

double mean_step(const Trajectory& trajectory) {
  constexpr const char* kWhere = "mean_step";
  check_argument(trajectory.samples() >= 2, kWhere, "the record has fewer than two samples");
  const double mean = trajectory.duration() / static_cast<double>(trajectory.samples() - 1);
  check_argument(std::isfinite(mean), kWhere, "the times are not finite");
  return mean;
}

std::optional<double> uniform_step(const Trajectory& trajectory, double tolerance) {
  const Vector& time = trajectory.time;
  if (time.size() < 2) return std::nullopt;
  const double mean = trajectory.duration() / static_cast<double>(time.size() - 1);
  if (!std::isfinite(mean)) return std::nullopt;
  const auto steps = (time.tail(time.size() - 1) - time.head(time.size() - 1)).array();
  const bool uniform = ((steps - mean).abs() <= tolerance * std::abs(mean)).all();
  return uniform ? std::optional<double>(mean) : std::nullopt;
}

Trajectory rows_of(const Trajectory& trajectory, Index first, Index count) {
  check_rows(trajectory, "rows_of");
  check_part(first, count, trajectory.samples(), "rows_of");
  const auto part = [&](const Matrix& values) -> Matrix {
    if (values.rows() == 0) return Matrix(0, 0);
    return values.middleRows(first, count);
  };
  return {
      trajectory.source,       trajectory.time.segment(first, count), part(trajectory.states),
      part(trajectory.inputs), part(trajectory.derivatives),          part(trajectory.marks)};
}

std::string file_of(const Trajectory& trajectory) {
  return trajectory.source.substr(0, end_of_file_name(trajectory.source));
}

bool goes_on(const Trajectory& before, const Trajectory& after, double longest_gap) {
  if (before.samples() == 0 || after.samples() == 0) return false;
  const double gap = after.time[0] - before.time[before.samples() - 1];
  return record_of(before.source) == record_of(after.source) && gap > 0.0 &&
         gap <= longest_gap;
}

}  // namespace lacuna
