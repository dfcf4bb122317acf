// SPDX-License-Identifier: MIT
#include "state_statistics.hpp"

#include <algorithm>
#include <limits>

namespace lacuna {

double state_variance(const Dataset& data, Index state) {
  double sum = 0.0, squares = 0.0;
  for (const Trajectory& record : data.trajectories) sum += record.states.col(state).sum();
  const auto count = static_cast<double>(data.samples());
  const double mean = sum / count;
  for (const Trajectory& record : data.trajectories)
    squares += (record.states.col(state).array() - mean).square().sum();
  return squares / count;
}

Vector state_spans(const Dataset& data) {
  Vector low = data.trajectories.front().states.colwise().minCoeff();
  Vector high = data.trajectories.front().states.colwise().maxCoeff();
  for (const Trajectory& record : data.trajectories) {
    low = low.cwiseMin(record.states.colwise().minCoeff().transpose());
    high = high.cwiseMax(record.states.colwise().maxCoeff().transpose());
  }
  return (high - low).cwiseMax(std::numeric_limits<double>::min());
}

bool has_marks(const Dataset& data) {
  return std::any_of(data.trajectories.begin(), data.trajectories.end(),
                     [](const Trajectory& record) { return record.marks.size() > 0; });
}

}  // namespace lacuna
