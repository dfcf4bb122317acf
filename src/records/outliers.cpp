// SPDX-License-Identifier: MIT
#include "lacuna/records/outliers.hpp"

#include <Eigen/QR>
#include <cmath>

namespace lacuna {
namespace {

/// Whether the record is smooth but for this sample: a cubic goes through its neighbours to
/// the noise, and not through the sample. Where a fast stretch is sampled coarsely no cubic
/// goes through the neighbours either.
/// @param off what is off. @param marked samples that are not to be used as neighbours.
bool stands_out(const Trajectory& record, Index state, Index i, double off,
                const std::vector<bool>& marked) {
  constexpr std::size_t kEachSide = 3;
  std::vector<Index> around;
  for (Index j = i - 1; j >= 0 && around.size() < kEachSide; --j)
    if (!marked[static_cast<std::size_t>(j)]) around.push_back(j);
  const std::size_t before = around.size();
  for (Index j = i + 1; j < record.samples() && around.size() < before + kEachSide; ++j)
    if (!marked[static_cast<std::size_t>(j)]) around.push_back(j);
  if (around.size() < 2 * kEachSide) return true;
  Matrix powers(static_cast<Index>(around.size()), 4);
  Vector values(powers.rows());
  const double reach = record.time[around.back()] - record.time[i];
  for (Index row = 0; row < powers.rows(); ++row) {
    const Index j = around[static_cast<std::size_t>(row)];
    const double s = (record.time[j] - record.time[i]) / reach;
    powers.row(row) << 1.0, s, s * s, s * s * s;
    values[row] = record.states(j, state);
  }
  const Vector cubic = powers.colPivHouseholderQr().solve(values);
  const double left = (values - powers * cubic).norm();
  return left < off && std::abs(record.states(i, state) - cubic[0]) > off;
}

}  // namespace

std::vector<Matrix> mark_outliers(const Dataset& data, const std::vector<StateNoise>& noise,
                                  double deviations) {
  std::vector<Matrix> marks;
  for (const Trajectory& record : data.trajectories)
    marks.push_back(Matrix::Zero(record.samples(), data.state_count()));
  for (Index k = 0; k < data.state_count(); ++k) {
    const StateNoise& seen = noise[static_cast<std::size_t>(k)];
    if (!data.is_measured(k) || seen.kind == NoiseKind::None || seen.sigma <= 0.0) continue;
    for (std::size_t r = 0; r < marks.size(); ++r) {
      const Trajectory& record = data.trajectories[r];
      const std::vector<Index> suspects = outlying_samples(record, k, seen.sigma, deviations);
      std::vector<bool> marked(static_cast<std::size_t>(record.samples()), false);
      for (const Index i : suspects) marked[static_cast<std::size_t>(i)] = true;
      for (const Index i : suspects)
        if (stands_out(record, k, i, deviations * seen.sigma, marked)) marks[r](i, k) = 1.0;
    }
  }
  return marks;
}

}  // namespace lacuna
