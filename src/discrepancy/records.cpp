// SPDX-License-Identifier: MIT
#include "records.hpp"

#include "lacuna/data/noise.hpp"

namespace lacuna {
namespace {

Trajectory rows_of(const Trajectory& record, Index first, Index count,
                   const std::string& addition) {
  Trajectory part;
  part.source = record.source + addition;
  part.time = record.time.segment(first, count);
  part.states = record.states.middleRows(first, count);
  part.inputs = record.inputs.middleRows(first, count);
  return part;
}

}  // namespace

std::pair<Dataset, Dataset> split_in_time(const Dataset& data) {
  Dataset find = data, check = data;
  find.trajectories.clear();
  check.trajectories.clear();
  for (const Trajectory& record : data.trajectories) {
    const Index kept = record.samples() - record.samples() / 4;
    find.trajectories.push_back(rows_of(record, 0, kept, ""));
    check.trajectories.push_back(
        rows_of(record, kept, record.samples() - kept, ", last quarter"));
  }
  return {std::move(find), std::move(check)};
}

std::vector<Matrix> mark_outliers(const Dataset& data, std::vector<std::string>& notes) {
  const std::vector<StateNoise> noise = analyse_noise(data);
  std::vector<Matrix> marks;
  for (const Trajectory& record : data.trajectories)
    marks.push_back(Matrix::Zero(record.samples(), data.state_count()));
  for (Index k = 0; k < data.state_count(); ++k) {
    const StateNoise& seen = noise[static_cast<std::size_t>(k)];
    if (!data.is_measured(k) || seen.kind == NoiseKind::None || seen.sigma <= 0.0) continue;
    Index count = 0;
    for (std::size_t r = 0; r < marks.size(); ++r)
      for (const Index i : outlying_samples(data.trajectories[r], k, seen.sigma)) {
        marks[r](i, k) = 1.0;
        ++count;
      }
    if (count > 0)
      notes.push_back(std::to_string(count) + " outliers of " +
                      data.states[static_cast<std::size_t>(k)].name + " were left out");
  }
  return marks;
}

}  // namespace lacuna
