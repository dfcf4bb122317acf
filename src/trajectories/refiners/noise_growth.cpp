// SPDX-License-Identifier: MIT
#include "noise_growth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/statistics/robust_statistics.hpp"

namespace lacuna {
namespace {

/// Samples of which one has the median absolute deviation as its scale.
struct Group {
  double level = 0.0;      ///< rms of the signal
  double log_scale = 0.0;  ///< of the differences
  double weight = 0.0;     ///< 1 / variance of log_scale
};

Group group_of(const Vector& signal, const Vector& sizes, const Index* first,
               const Index* last) {
  constexpr double kVarianceOfLogScale = 1.36;  // a fact of normal noise, times n
  Group group;
  std::vector<double> values;
  for (const Index* i = first; i != last; ++i) {
    group.level += signal[*i] * signal[*i];
    values.push_back(sizes[*i]);
  }
  const auto count = static_cast<double>(values.size());
  group.level = std::sqrt(group.level / count);
  group.log_scale = std::log(std::max(normal_deviation(std::move(values)), 1e-300));
  group.weight = count / kVarianceOfLogScale;
  return group;
}

/// Groups of the same number of samples, by rising size of the signal.
std::vector<Group> groups_by_level(const SizedDifferences& differences, Index count) {
  const Vector& signal = differences.signal;
  const Index n = signal.size();
  // Sizes stand beside their places: a sort that looks them up waits for memory.
  std::vector<std::pair<double, Index>> sizes;
  sizes.reserve(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) sizes.emplace_back(std::abs(signal[i]), i);
  std::stable_sort(sizes.begin(), sizes.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Index> order;
  order.reserve(sizes.size());
  for (const auto& [size, place] : sizes) order.push_back(place);
  std::vector<Group> groups;
  for (Index g = 0; g < count; ++g)
    groups.push_back(group_of(signal, differences.sizes, order.data() + n * g / count,
                              order.data() + n * (g + 1) / count));
  return groups;
}

/// The groups that show noise: where deviations level off from order to order, with their mean
/// from there on.
std::vector<Group> noisy_groups(const std::vector<SizedDifferences>& orders) {
  // Facts of the statistic: a scale of fewer is not known; more groups resolve no better.
  constexpr Index kFewestOfAGroup = 16, kMostGroups = 12;
  const double level = std::log(kLevelledOff);
  const Index count = std::min(kMostGroups, orders.back().signal.size() / kFewestOfAGroup);
  std::vector<std::vector<Group>> by_order;
  for (const SizedDifferences& differences : orders)
    by_order.push_back(groups_by_level(differences, count));
  std::vector<Group> groups;
  for (std::size_t g = 0; g < static_cast<std::size_t>(count); ++g) {
    std::size_t first = 0;  // order from which deviations do not fall noticeably
    while (first + 1 < by_order.size() &&
           by_order[first + 1][g].log_scale < by_order[first][g].log_scale + level)
      ++first;
    if (first + 1 == by_order.size()) continue;
    Group group = by_order[first][g];
    for (std::size_t o = first + 1; o < by_order.size(); ++o)
      group.log_scale += by_order[o][g].log_scale;
    group.log_scale /= static_cast<double>(by_order.size() - first);
    groups.push_back(group);
  }
  return groups;
}

/// Weighted squares that scale x sqrt(1 + ratio level^2) leaves in the groups, with the scale
/// that leaves least.
struct ScaleFit {
  double squares = 0.0;
  double log_scale = 0.0;
};

ScaleFit fit_scale(const std::vector<Group>& groups, double ratio) {
  double weight = 0.0, mean = 0.0, squares = 0.0;
  for (const Group& group : groups) {
    const double rest = group.log_scale - 0.5 * std::log1p(ratio * group.level * group.level);
    weight += group.weight;
    mean += group.weight * rest;
    squares += group.weight * rest * rest;
  }
  mean /= weight;
  return {squares - weight * mean * mean, mean};
}

/// Differences of one order in all records together.
SizedDifferences differences_of(const Dataset& data, Index state, Index order) {
  SizedDifferences all{Vector(data.samples()), Vector(data.samples())};
  Index count = 0;
  for (const Trajectory& record : data.trajectories) {
    const Vector sizes = difference_sizes(record, state, order);
    for (Index i = 0; i < sizes.size(); ++i, ++count) {
      all.signal[count] = record.states.col(state).segment(i, order + 1).mean();
      all.sizes[count] = sizes[i];
    }
  }
  all.signal.conservativeResize(count);
  all.sizes.conservativeResize(count);
  return all;
}

std::optional<NoiseGrowth> growth_of(const Dataset& data, Index state, Index order,
                                     const GrowingNoise& rule) {
  // A fact of the statistic: orders that are compared, from the first that shows noise on.
  constexpr Index kOrders = 5;
  std::vector<SizedDifferences> orders;
  for (Index o = order; o < order + kOrders; ++o)
    orders.push_back(differences_of(data, state, o));
  return noise_growth(orders, rule);
}

/// Root mean square of a signal over at most `reach` samples to either side.
Vector local_rms(const Vector& x, Index reach) {
  Vector result(x.size());
  for (Index i = 0; i < x.size(); ++i) {
    const Index first = std::max<Index>(0, i - reach), last = std::min(x.size() - 1, i + reach);
    const Index count = last - first + 1;
    result[i] = x.segment(first, count).norm() / std::sqrt(static_cast<double>(count));
  }
  return result;
}

/// Whether differences are of unit variance in units of the growing noise, outliers apart. What
/// a solver leaves comes in bursts, which a level does not explain.
bool describes(const NoiseGrowth& growth, const SizedDifferences& differences, double most) {
  double squares = 0.0, count = 0.0;
  for (Index i = 0; i < differences.sizes.size(); ++i) {
    const double size = differences.sizes[i] / growth.at(differences.signal[i]);
    if (size > kOutlyingDeviations) continue;
    squares += size * size;
    ++count;
  }
  return squares <= most * most * count;
}

}  // namespace

double NoiseGrowth::at(double x) const { return std::hypot(floor, fraction * x); }

std::optional<NoiseGrowth> noise_growth(const std::vector<SizedDifferences>& orders,
                                        const GrowingNoise& rule) {
  constexpr double kRatioOfTrials = 1.25893;  // a tenth of a decade
  const std::vector<Group> groups = noisy_groups(orders);
  if (groups.size() < 3 || !(groups.back().level > 0.0)) return std::nullopt;
  const double unit = 1.0 / (groups.back().level * groups.back().level);
  const ScaleFit same = fit_scale(groups, 0.0);
  ScaleFit best = same;
  double ratio = 0.0;
  for (double trial = 1e-2; trial < 1e8; trial *= kRatioOfTrials)
    if (const ScaleFit fit = fit_scale(groups, trial * unit); fit.squares < best.squares) {
      best = fit;
      ratio = trial * unit;
    }
  if (same.squares - best.squares < rule.significance * rule.significance) return std::nullopt;
  const double floor = std::exp(best.log_scale);
  const NoiseGrowth growth{floor, floor * std::sqrt(ratio)};
  if (growth.fraction < rule.least_fraction ||
      !describes(growth, orders.back(), rule.unit_variance))
    return std::nullopt;
  return growth;
}

SampleNoise noise_of_samples(const Dataset& data, const Vector& sigma,
                             const std::vector<StateNoise>& noise, const GrowingNoise& rule,
                             int threads) {
  SampleNoise result{
      {}, sigma, std::vector<std::optional<NoiseGrowth>>(noise.size(), std::nullopt)};
  for (const Trajectory& record : data.trajectories)
    result.deviations.push_back(sigma.transpose().replicate(record.samples(), 1));
  parallel_for(noise.size(), threads, [&](std::size_t state) {
    const auto k = static_cast<Index>(state);
    const StateNoise& seen = noise[state];
    std::optional<NoiseGrowth>& growth = result.growth[state];
    if (data.is_measured(k) && seen.kind == NoiseKind::White)
      growth = growth_of(data, k, seen.order, rule);
    if (!growth) return;
    double squares = 0.0;
    for (std::size_t r = 0; r < result.deviations.size(); ++r) {
      auto deviations = result.deviations[r].col(k);
      deviations = local_rms(data.trajectories[r].states.col(k), seen.order)
                       .unaryExpr([&](double level) { return growth->at(level); });
      squares += deviations.squaredNorm();
    }
    result.rms[k] = std::sqrt(squares / static_cast<double>(data.samples()));
  });
  return result;
}

}  // namespace lacuna
