// SPDX-License-Identifier: MIT
#include "safety.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.hpp"

namespace lacuna {
namespace {

/// What an excess is a fraction of.
double width_of(const SafeRange& range) {
  const double width = range.high - range.low;
  if (std::isfinite(width) && width > 0.0) return width;
  const double end = std::isfinite(range.high) ? range.high : range.low;
  return std::isfinite(end) ? std::max(1.0, std::abs(end)) : 1.0;
}

/// The excess of each draw, in their order; each lane of work has a model of its own.
std::vector<double> excesses(const ModelRun& model, const Experiment& experiment,
                             const std::vector<SafeRange>& ranges,
                             const std::vector<PathNumbers>& draws, const RunContext& context) {
  constexpr std::size_t kLane = 64;  // draws that share a copy of the model
  std::vector<double> all(draws.size());
  parallel_for((draws.size() + kLane - 1) / kLane, context.threads, [&](std::size_t lane) {
    context.check_stop();
    ModelRun run = model;
    load(run, experiment);
    for (std::size_t k = lane * kLane; k < std::min(draws.size(), (lane + 1) * kLane); ++k)
      all[k] = excess_of(predict(run, experiment, in_experiment(run, experiment, draws[k])),
                         ranges);
  });
  return all;
}

/// Of those that leave, beyond the fraction that may, some: from the least excess on, for with
/// these inside the others may stay outside.
std::vector<PathNumbers> to_keep_inside(const std::vector<PathNumbers>& draws,
                                        const std::vector<double>& excess, double allowed) {
  constexpr std::size_t kAdded = 6;
  std::vector<std::size_t> order(draws.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return excess[a] > excess[b]; });
  std::vector<PathNumbers> kept;
  auto next = static_cast<std::size_t>(allowed * double(draws.size()) / 2.0);
  const std::size_t stride = std::max<std::size_t>(1, draws.size() / 100);
  for (; next < order.size() && kept.size() < kAdded && excess[order[next]] > 0.0;
       next += stride)
    kept.push_back(draws[order[next]]);
  return kept;
}

}  // namespace

double excess_of(const Prediction& prediction, const std::vector<SafeRange>& ranges) {
  if (!prediction.is_finite) return std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto values = prediction.safe.col(static_cast<Index>(i)).array();
    const double beyond =
        std::max(values.maxCoeff() - ranges[i].high, ranges[i].low - values.minCoeff());
    most = std::max(most, beyond / width_of(ranges[i]));
  }
  return most;
}

double worst_excess(Rivals& rivals, const Experiment& experiment,
                    const std::vector<SafeRange>& ranges,
                    const std::vector<std::vector<PathNumbers>>& draws) {
  double worst = 0.0;
  for (std::size_t i = 0; i < rivals.runs.size(); ++i) {
    ModelRun& run = rivals.runs[i];
    load(run, experiment);
    worst = std::max(worst, excess_of(predict(run, experiment, {run.values, {}}), ranges));
    for (const PathNumbers& draw : draws[i])
      worst = std::max(worst, excess_of(predict(run, experiment,
                                                in_experiment(run, experiment, draw)),
                                        ranges));
  }
  return worst;
}

SafetyCheck check_safety(const Rivals& rivals, const Experiment& experiment,
                         const std::vector<SafeRange>& ranges, int count, double allowed,
                         const RunContext& context) {
  SafetyCheck check;
  check.offending.resize(rivals.runs.size());
  for (std::size_t i = 0; i < rivals.runs.size(); ++i) {
    const std::vector<PathNumbers> draws =
        draws_of(rivals.runs[i], rivals.knowledge[i], count, context.seed + 7919 * (i + 1));
    const std::vector<double> excess =
        excesses(rivals.runs[i], experiment, ranges, draws, context);
    const auto left = std::count_if(excess.begin(), excess.end(),
                                    [](double one) { return one > 0.0; });
    const double fraction = static_cast<double>(left) / double(draws.size());
    check.leaves = std::max(check.leaves, fraction);
    if (fraction > allowed) check.offending[i] = to_keep_inside(draws, excess, allowed);
  }
  return check;
}

}  // namespace lacuna
