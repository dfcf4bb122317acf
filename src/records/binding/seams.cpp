// SPDX-License-Identifier: MIT
#include "seams.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "records/channels/outliers.hpp"

namespace lacuna {
namespace {

// A decision (docs/decisions/numbers.md).
constexpr double kSeam = 3.0;

/// A fact: who joins more runs than these with no time between them would be asked to cut them.
constexpr std::size_t kMostSeams = 8;

/// Change per unit of time of each step, 0 where a sample shows nothing; n - 1.
Vector speeds(const Trajectory& record, const Vector& values) {
  Vector result(record.samples() - 1);
  for (Index i = 0; i < result.size(); ++i) {
    const double change = values[i + 1] - values[i];
    result[i] = std::isfinite(change) ? change / (record.time[i + 1] - record.time[i]) : 0.0;
  }
  return result;
}

/// How far the speed of a step is outside of those of the steps beside it, between which a motion
/// that goes on has it, and a position at an impact too.
Vector breaks(const Vector& speed) {
  Vector result = Vector::Zero(speed.size());
  for (Index i = 1; i + 1 < speed.size(); ++i) {
    const auto [low, high] = std::minmax({speed[i - 1], speed[i + 1]});
    result[i] = std::max({low - speed[i], speed[i] - high, 0.0});
  }
  return result;
}

/// Steps in which a channel breaks off more than kSeam times as much as in the others, in the
/// order of the record.
std::vector<Index> jumps(const Vector& broken) {
  std::vector<Index> steps(static_cast<std::size_t>(broken.size()));
  std::iota(steps.begin(), steps.end(), Index{0});
  const std::size_t looked_at = std::min(steps.size(), kMostSeams + 1);
  std::partial_sort(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(looked_at),
                    steps.end(), [&](Index a, Index b) { return broken[a] > broken[b]; });
  for (std::size_t count = looked_at; count-- > 1;) {
    if (!(broken[steps[count - 1]] > kSeam * broken[steps[count]])) continue;
    steps.resize(count);
    std::sort(steps.begin(), steps.end());
    return steps;
  }
  return {};
}

/// The largest value but those of some steps.
double largest_but(const Vector& values, const std::set<Index>& steps) {
  double largest = 0.0;
  for (Index i = 0; i < values.size(); ++i)
    if (!steps.contains(i)) largest = std::max(largest, values[i]);
  return largest;
}

/// The largest change of speed from a step to the next, but where one of them is among some steps.
double largest_change_but(const Vector& speed, const std::set<Index>& steps) {
  double largest = 0.0;
  for (Index i = 0; i + 1 < speed.size(); ++i)
    if (!steps.contains(i) && !steps.contains(i + 1))
      largest = std::max(largest, std::abs(speed[i + 1] - speed[i]));
  return largest;
}

/// A measured state step by step.
struct Motion {
  Vector speed, broken;
};

/// Whether an input changes in a step, in the one before it or in the one behind it.
bool input_changes(const Trajectory& record, Index step) {
  const Index begin = std::max<Index>(step - 1, 0);
  const Index end = std::min(step + 2, record.samples() - 1);
  for (Index j = 0; j < record.inputs.cols(); ++j)
    for (Index i = begin; i < end; ++i)
      if (record.inputs(i + 1, j) != record.inputs(i, j)) return true;
  return false;
}

}  // namespace

std::vector<Index> seams(const Dataset& data, const Trajectory& record) {
  std::vector<Motion> channels;
  std::set<Index> steps;
  if (record.samples() < 3) return {};
  for (Index k = 0; k < data.state_count(); ++k) {
    if (!data.is_measured(k)) continue;
    const Vector speed = speeds(record, record.states.col(k));
    channels.push_back({speed, breaks(speed)});
    const std::vector<Index> own = jumps(channels.back().broken);
    steps.insert(own.begin(), own.end());
  }
  const std::set<Index> jumping = steps;
  for (const auto& [speed, broken] : channels) {
    // A device that stands still all at once changes its speed, and no more than it does elsewhere.
    const double usual =
        std::max(largest_but(broken, jumping), largest_change_but(speed, jumping));
    std::erase_if(steps, [&, &broken = broken](Index step) { return !(broken[step] > usual); });
  }
  if (channels.size() == 1)
    std::erase_if(steps, [&](Index step) { return input_changes(record, step); });
  const std::vector<Index> common(steps.begin(), steps.end());
  std::vector<Index> firsts;
  for (std::size_t i = 0; i < common.size(); ++i) {
    const bool returns = (i > 0 && common[i] - common[i - 1] <= kLongestRun) ||
                         (i + 1 < common.size() && common[i + 1] - common[i] <= kLongestRun);
    if (!returns) firsts.push_back(common[i] + 1);
  }
  return firsts;
}

}  // namespace lacuna
