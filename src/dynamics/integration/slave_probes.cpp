// SPDX-License-Identifier: MIT
#include "slave_probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "sync_errors.hpp"

namespace lacuna {

Vector response_to_noise(const SlaveTask& task, const Dataset& record,
                         const SyncResult& result) {
  const Vector none = Vector::Zero(record.state_count());
  if (result.status != IntegrationStatus::Completed || !(result.noise.maxCoeff() > 0.0))
    return none;
  Random random(task.context.seed);
  std::vector<Matrix> states;
  for (Trajectory noisier : record.trajectories) {
    for (Index n = 0; n < noisier.samples(); ++n)
      for (Index k = 0; k < none.size(); ++k)
        noisier.states(n, k) += result.noise[k] * random.normal();
    SlaveRun run = run_slave(task, noisier, start_of(task, noisier));
    if (run.status != IntegrationStatus::Completed) return none;
    states.push_back(std::move(run.states));
  }
  return late_errors(states, result.states);
}

double conditional_exponent(const SlaveTask& task, const Trajectory& record,
                            const SyncResult& result) {
  constexpr double kResolved = 1e-6;  // a fact of doubles: well above their rounding
  const Matrix& own = result.states.front();
  Vector reach = (own.colwise().maxCoeff() - own.colwise().minCoeff()).transpose();
  reach = (reach.array() > 0.0).select(reach, 1.0);
  const Vector weight = (1.0 - task.seen.array()) / reach.array();
  const Vector start =
      start_of(task, record) + (1.0 - task.seen.array()).matrix().cwiseProduct(reach);
  const SlaveRun other = run_slave(task, record, start);
  if (other.status != IntegrationStatus::Completed ||
      result.status != IntegrationStatus::Completed)
    return std::numeric_limits<double>::infinity();
  const Vector distance = ((other.states - own) * weight.asDiagonal()).rowwise().norm();
  Index n = 1;
  while (n + 1 < distance.size() && distance[n] > kResolved * distance[0]) ++n;
  return std::log(std::max(distance[n], 1e-300) / distance[0]) /
         (record.time[n] - record.time[0]);
}

}  // namespace lacuna
