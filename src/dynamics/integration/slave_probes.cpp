// SPDX-License-Identifier: MIT
#include "slave_probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
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

Vector response_to_start(const SlaveTask& task, const Dataset& record,
                         const SyncResult& result) {
  Vector squares = Vector::Zero(record.state_count());
  const bool is_off = result.error_over_noise && *result.error_over_noise > 1.0;
  if (result.status != IntegrationStatus::Completed || task.start || !is_off) return squares;
  for (Index k = 0; k < squares.size(); ++k) {
    if (!(task.seen[k] * result.noise[k] > 0.0)) continue;
    std::vector<Matrix> states;
    for (const Trajectory& trajectory : record.trajectories) {
      Vector start = start_of(task, trajectory);
      start[k] += result.noise[k];
      SlaveRun run = run_slave(task, trajectory, start);
      if (run.status != IntegrationStatus::Completed) return Vector::Zero(squares.size());
      states.push_back(std::move(run.states));
    }
    squares += late_errors(states, result.states).cwiseAbs2();
  }
  return squares.cwiseSqrt();
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

std::vector<Matrix> step_errors(const SlaveTask& task, const Dataset& record,
                                const SyncResult& result) {
  SlaveTask finer = task;
  finer.parts = 2 * task.parts;
  finer.window = LagrangeWindow::centred(task.integrator.order() / 2 * 2 + 2);
  std::vector<Matrix> errors;
  for (std::size_t r = 0; r < record.trajectories.size(); ++r) {
    const Trajectory& trajectory = record.trajectories[r];
    if (trajectory.samples() < finer.window.points) return {};
    const SlaveRun run = run_slave(finer, trajectory, start_of(finer, trajectory));
    if (run.status != IntegrationStatus::Completed) return {};
    errors.emplace_back(result.states[r] - run.states);
  }
  return errors;
}

bool is_faster_than_samples(const SlaveTask& task, const Dataset& record) {
  const Rk4 steps;
  const SlaveTask fixed{task.model, task.coupling, steps,       task.window,
                        task.start, task.seen,     task.context};
  return std::any_of(
      record.trajectories.begin(), record.trajectories.end(),
      [&](const Trajectory& trajectory) {
        return run_slave(fixed, trajectory, start_of(fixed, trajectory)).status !=
               IntegrationStatus::Completed;
      });
}

}  // namespace lacuna
