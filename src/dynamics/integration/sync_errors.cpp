// SPDX-License-Identifier: MIT
#include "sync_errors.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/statistics/robust_statistics.hpp"

namespace lacuna {
namespace {

/// Root mean square of the errors from one fraction of every trajectory to another.
double rms_between(const std::vector<Vector>& errors, double from, double to) {
  double squares = 0.0;
  Index count = 0;
  for (const Vector& e : errors) {
    const double n = static_cast<double>(e.size());
    const auto begin = static_cast<Index>(from * n), end = static_cast<Index>(to * n);
    squares += e.segment(begin, end - begin).squaredNorm();
    count += end - begin;
  }
  return std::sqrt(squares / static_cast<double>(std::max<Index>(count, 1)));
}

/// Root mean square distance of the samples from their mean.
double spread(const Dataset& record) {
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(record.state_count());
  for (const Trajectory& trajectory : record.trajectories)
    mean += trajectory.states.colwise().sum();
  mean /= static_cast<double>(record.samples());
  double squares = 0.0;
  for (const Trajectory& trajectory : record.trajectories)
    squares += (trajectory.states.rowwise() - mean).squaredNorm();
  return std::sqrt(squares / static_cast<double>(record.samples()));
}

}  // namespace

double largest_norm(const Dataset& record) {
  double largest = 0.0;
  for (const Trajectory& trajectory : record.trajectories)
    largest =
        std::max(largest, std::sqrt(trajectory.states.rowwise().squaredNorm().maxCoeff()));
  return largest;
}

void add_statistics(const Dataset& record, SyncResult& result) {
  std::vector<double> all;
  for (const Vector& errors : result.errors)
    all.insert(all.end(), errors.begin(), errors.end());
  double sum = 0.0;
  for (const double error : all) sum += error;
  result.mean = sum / static_cast<double>(all.size());
  result.median = median(std::move(all));
  const double largest = largest_norm(record);
  result.relative = largest > 0.0 ? result.mean / largest : 0.0;
}

Vector late_errors(const std::vector<Matrix>& slaves, const std::vector<Matrix>& paths) {
  Vector squares = Vector::Zero(slaves.front().cols());
  double count = 0.0;
  for (std::size_t r = 0; r < slaves.size(); ++r) {
    const Index n = slaves[r].rows(), late = n - n / 4;
    const Matrix left = (slaves[r] - paths[r].topRows(n)).bottomRows(late);
    squares += left.colwise().squaredNorm().transpose();
    count += static_cast<double>(late);
  }
  return (squares / count).cwiseSqrt();
}

std::optional<double> error_over_noise(const Dataset& record, const SyncResult& result) {
  std::vector<Matrix> paths;
  for (const Trajectory& trajectory : record.trajectories) paths.push_back(trajectory.states);
  const Vector errors = late_errors(result.states, paths);
  std::optional<double> worst;
  for (Index k = 0; k < errors.size(); ++k)
    if (record.is_measured(k) && result.noise[k] > 0.0)
      worst = std::max(worst.value_or(0.0), errors[k] / result.noise[k]);
  return worst;
}

bool has_settled(const Dataset& record, const SyncResult& result) {
  if (result.status != IntegrationStatus::Completed) return false;
  const double own = spread(record);
  const double late = rms_between(result.errors, 0.75, 1.0);
  const double before = rms_between(result.errors, 0.25, 0.75);
  const double rounding = 1e-12 * largest_norm(record);
  return late <= rounding || (late <= 3.0 * before && late < 0.5 * own);
}

}  // namespace lacuna
