// SPDX-License-Identifier: MIT
#include "other_starts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lacuna {
namespace {

/// The numbers from 0 to count - 1 in random order.
std::vector<int> shuffled(int count, Random& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

/// The number so far (0 to 1) from the lower to the upper end, by logarithms of a positive range.
double within(double lower, double upper, double fraction) {
  return lower > 0.0 ? lower * std::pow(upper / lower, fraction)
                     : lower + (upper - lower) * fraction;
}

/// A state as far inside of an end of its range as it was outside.
double mirrored_into(const StateRanges& inside, Index state, double value) {
  if (inside.lower.size() == 0) return value;
  if (value < inside.lower[state]) value = 2.0 * inside.lower[state] - value;
  if (value > inside.upper[state]) value = 2.0 * inside.upper[state] - value;
  return std::max(value, inside.lower[state]);
}

}  // namespace

FitPoint other_start(FitEngine& engine, const FitUnknowns& unknowns, FitPoint point,
                     double spread, Random& random) {
  for (Index p = 0; p < point.parameters.cols(); ++p) {
    const double factor = std::exp(std::log(spread) * random.uniform(-1.0, 1.0));
    point.parameters.col(p) = (factor * point.parameters.col(p))
                                  .cwiseMax(unknowns.lower[p])
                                  .cwiseMin(unknowns.upper[p]);
  }
  const std::vector<bool>& guessed = engine.records.guessed;
  if (std::find(guessed.begin(), guessed.end(), true) == guessed.end()) return point;
  const FitPath path = follow(engine, point, {});
  const Vector scale = disturbances_of(engine, path, 1.0).scale;
  for (Index k = 0; k < engine.states(); ++k)
    if (guessed[static_cast<std::size_t>(k)])
      for (Index r = 0; r < point.starts.rows(); ++r)
        point.starts(r, k) =
            mirrored_into(engine.records.inside, k, scale[k] * random.normal());
  return point;
}

std::optional<FitPoint> raised(FitEngine& engine, FitPoint point, double sign) {
  const Vector scale = disturbances_of(engine, follow(engine, point, {}), 1.0).scale;
  bool any = false;
  for (Index k = 0; k < engine.states(); ++k) {
    if (!engine.records.guessed[static_cast<std::size_t>(k)]) continue;
    for (double& value : point.starts.col(k)) {
      const double moved = value + sign * scale[k];
      if (mirrored_into(engine.records.inside, k, moved) != moved) continue;
      value = moved;
      any = true;
    }
  }
  return any ? std::optional(std::move(point)) : std::nullopt;
}

FitPoint off_edges(FitEngine& engine, FitPoint point) {
  const StateRanges& inside = engine.records.inside;
  std::vector<std::pair<double*, Index>> at_edges;  // values and their states
  for (Index k = 0; k < inside.lower.size(); ++k)
    for (double& value : point.starts.col(k))
      if (engine.records.guessed[static_cast<std::size_t>(k)] &&
          (value == inside.lower[k] || value == inside.upper[k]))
        at_edges.emplace_back(&value, k);
  if (at_edges.empty()) return point;
  const Vector scale = disturbances_of(engine, follow(engine, point, {}), 1.0).scale;
  for (const auto& [value, k] : at_edges) *value = mirrored_into(inside, k, *value + scale[k]);
  return point;
}

bool is_wide(double lower, double upper, double spread) {
  return lower > 0.0 && std::isfinite(upper) && upper / lower > std::pow(spread, 4.0);
}

bool has_wide_range(const FitUnknowns& unknowns, double spread) {
  return std::any_of(unknowns.global.begin(), unknowns.global.end(), [&](Index p) {
    return is_wide(unknowns.lower[p], unknowns.upper[p], spread);
  });
}

std::vector<FitPoint> starts_over_ranges(FitEngine& engine, const FitUnknowns& unknowns,
                                         const FitPoint& start, int count, double spread,
                                         Random& random) {
  std::vector<FitPoint> starts;
  for (int i = 0; i < count; ++i)
    starts.push_back(other_start(engine, unknowns, start, spread, random));
  for (const Index p : unknowns.global) {
    const double lower = unknowns.lower[p], upper = unknowns.upper[p];
    if (!std::isfinite(lower) || !std::isfinite(upper)) continue;
    const std::vector<int> strata = shuffled(count, random);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const double fraction = (strata[i] + random.uniform()) / count;
      starts[i].parameters.col(p).setConstant(within(lower, upper, fraction));
    }
  }
  return starts;
}

}  // namespace lacuna
