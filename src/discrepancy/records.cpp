// SPDX-License-Identifier: MIT
#include "records.hpp"

#include <cmath>

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

std::vector<Matrix> mark_outliers(const Dataset& data) {
  const std::vector<StateNoise> noise = analyse_noise(data);
  std::vector<Matrix> marks;
  for (const Trajectory& record : data.trajectories)
    marks.push_back(Matrix::Zero(record.samples(), data.state_count()));
  for (Index k = 0; k < data.state_count(); ++k) {
    const StateNoise& seen = noise[static_cast<std::size_t>(k)];
    if (!data.is_measured(k) || seen.kind == NoiseKind::None || seen.sigma <= 0.0) continue;
    for (std::size_t r = 0; r < marks.size(); ++r)
      for (const Index i : outlying_samples(data.trajectories[r], k, seen.sigma))
        marks[r](i, k) = 1.0;
  }
  return marks;
}

bool clear_false_outliers(const Dataset& data, Assimilation& fit,
                          std::vector<std::string>& notes) {
  constexpr double kOutlying = 6.0;  // deviations of the noise
  bool cleared = false;
  for (Index k = 0; k < data.state_count(); ++k) {
    const auto& white = fit.noise.measurement[static_cast<std::size_t>(k)];
    if (!white) continue;
    Index count = 0;
    for (std::size_t r = 0; r < fit.omitted.size(); ++r)
      for (Index i = 0; i < fit.omitted[r].rows(); ++i) {
        if (fit.omitted[r](i, k) == 0.0) continue;
        const double off = std::abs(fit.measured[r](i, k) - fit.records[r].path(i, k));
        const bool outlier = off > kOutlying * *white;
        fit.omitted[r](i, k) = outlier ? 1.0 : 0.0;
        cleared = cleared || !outlier;
        count += outlier ? 1 : 0;
      }
    if (count > 0)
      notes.push_back(std::to_string(count) + " outliers of " +
                      data.states[static_cast<std::size_t>(k)].name + " were left out");
  }
  return cleared;
}

}  // namespace lacuna
