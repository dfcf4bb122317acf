// SPDX-License-Identifier: MIT
#include "window_groups.hpp"

#include <algorithm>
#include <utility>

#include "core/base/parallel.hpp"

namespace lacuna {
namespace {

/// A group has no fewer windows than a block of the rates has lanes, and no fewer steps than
/// make up for a thread that starts. Facts of cost.
constexpr Index kGroups = 16, kFewestWindows = 16, kFewestIntervals = 2048;

std::vector<WindowRange> groups_of(const WindowPlan& plan) {
  const auto windows = static_cast<Index>(plan.size());
  Index intervals = 0;
  for (const Window& window : plan) intervals += window.intervals;
  const Index groups = std::clamp<Index>(
      std::min(windows / kFewestWindows, intervals / kFewestIntervals), 1, kGroups);
  std::vector<WindowRange> ranges;
  for (Index g = 0; g < groups; ++g) {
    const Index first = g * windows / groups;
    ranges.push_back({first, (g + 1) * windows / groups - first});
  }
  return ranges;
}

}  // namespace

WindowGroups::Worker::Worker(const Rates& own, const StageSignals& signals)
    : rates(own), simulator(signals, own.dimension()), rows(rates, signals.scheme) {}

WindowGroups::WindowGroups(const Rates& rates, std::shared_ptr<const StageSignals> signals,
                           int threads)
    : rates_(rates), signals_(std::move(signals)), threads_(threads) {}

WindowGroups::Worker& WindowGroups::worker(std::size_t group, const Vector& parameters) {
  while (workers_.size() <= group)
    workers_.push_back(std::make_unique<Worker>(rates_, *signals_));
  workers_[group]->rates.set(parameters);
  return *workers_[group];
}

void WindowGroups::in_groups(const WindowPlan& plan, const Vector& parameters,
                             FunctionRef<void(Worker&, const WindowRange&)> work) {
  const std::vector<WindowRange> groups = groups_of(plan);
  for (std::size_t g = 0; g < groups.size(); ++g) worker(g, parameters);
  parallel_for(groups.size(), threads_, [&](std::size_t g) { work(*workers_[g], groups[g]); });
}

void WindowGroups::simulate(const WindowPlan& plan, const Vector& parameters,
                            const Matrix& starts, Orbits& orbits) {
  in_groups(plan, parameters, [&](Worker& own, const WindowRange& windows) {
    own.simulator.run(own.rates, plan, windows, starts, orbits);
  });
  orbits.diverged = diverged_windows(plan, orbits);
}

std::vector<Matrix> WindowGroups::triangles(const WindowRowsInput& input,
                                            const Vector& parameters, Matrix& transitions) {
  std::vector<Matrix> all(input.plan.size());
  in_groups(input.plan, parameters, [&](Worker& own, const WindowRange& windows) {
    own.rows.run(
        input, windows,
        [&](Index w, const Matrix& triangle) { all[static_cast<std::size_t>(w)] = triangle; },
        transitions);
  });
  return all;
}

void WindowGroups::sensitivities(
    const WindowRowsInput& input, const Vector& parameters,
    FunctionRef<void(Index window, Index sample, const Matrix&)> visit) {
  worker(0, parameters).rows.sensitivities(input, visit);
}

}  // namespace lacuna
