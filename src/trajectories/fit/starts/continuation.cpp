// SPDX-License-Identifier: MIT
#include "continuation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace lacuna {
namespace {

/// Fractions of their spread by which states are disturbed in one time scale, one after
/// another.
constexpr std::array<double, 6> kFractions = {3.0, 1.0, 0.3, 0.1, 0.03, 0.01};

/// And then, where the filter meets the noise and the free run does not.
constexpr std::array<double, 7> kFiner = {3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6};

/// Fits with a filter that allows for disturbances of this fraction. @return whether there is
/// one; `found` is where it ends then, its path that of the filter.
bool through_filter(FitEngine& engine, const FitUnknowns& unknowns, double fraction,
                    bool chooses_steps, const RunContext& context, FitMinimum& found) {
  constexpr int kRounds = 2, kIterations = 8;
  bool any = false;
  for (int round = 0; round < kRounds; ++round) {
    context.check_stop();
    const Disturbances disturbances = disturbances_of(engine, found.path, fraction);
    FitPath filtered;
    const Gains gains = filter_gains(engine, found.point, disturbances, filtered);
    if (!gains.allFinite() || !std::isfinite(filtered.cost)) continue;
    if (chooses_steps)
      choose_substeps(engine, found.point, gains,
                      0.1 * std::sqrt(engine.records.valid.sum()));
    FitMinimum next = minimise(engine, unknowns, found.point, gains, kIterations, context);
    if (!std::isfinite(next.path.cost)) continue;
    found = std::move(next);
    any = true;
  }
  return any;
}

}  // namespace

double excess_of_noise(const FitEngine& engine, const FitUnknowns& unknowns,
                       const FitMinimum& found) {
  if (!std::isfinite(found.path.cost)) return std::numeric_limits<double>::infinity();
  const Vector rms = residual_rms(engine, unknowns, found.path);
  double most = 0.0;
  for (std::size_t c = 0; c < engine.records.channels.size(); ++c) {
    const double noise = engine.records.channels[c].noise;
    const double size = rms[static_cast<Index>(c)];
    most = std::max(
        most, noise > 0.0 ? size / noise : size / (1e-4 * engine.records.channels[c].spread));
  }
  return most;
}

namespace {

/// Where a search through filters is when its time is up: at the numbers that it has come to, or
/// where it began, whichever run is nearer to the records.
FitMinimum so_far(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                  const FitPoint& reached) {
  FitMinimum begin{start, follow(engine, start, {})}, found{reached, follow(engine, reached, {})};
  begin.in_time = found.in_time = false;
  const double before = total_cost(unknowns, begin.point, begin.path);
  return total_cost(unknowns, found.point, found.path) < before ? found : begin;
}

/// @param filtered where it is; @throws OutOfTime past the deadline.
Continued through_filters(FitEngine& engine, const FitUnknowns& unknowns,
                          const FitSearchOptions& options, const RunContext& context,
                          FitMinimum& filtered) {
  {
    const RoughSteps rough(engine);
    for (std::size_t level = options.first_level; level < kFractions.size(); ++level)
      through_filter(engine, unknowns, kFractions[level], level == options.first_level, context,
                     filtered);
  }
  const auto freed = [&] {
    return minimise_in_time(engine, unknowns, filtered.point, {}, options.most_iterations,
                            context);
  };
  const auto meets_noise = [&](const FitMinimum& found) {
    return excess_of_noise(engine, unknowns, found) <= options.good;
  };
  FitMinimum best = freed(), last = best;
  if (!best.in_time) return {std::move(best)};
  for (const double fraction : kFiner) {
    if (meets_noise(best) || !meets_noise(filtered) ||
        !through_filter(engine, unknowns, fraction, false, context, filtered))
      return {std::move(best)};
    last = freed();
    if (last.path.cost < best.path.cost) best = last;
  }
  // A run that is not finite may be the fault of its begin, which the filter corrects.
  const bool departs =
      !meets_noise(best) && meets_noise(filtered) && std::isfinite(last.path.cost);
  return {departs ? std::move(last) : std::move(best), departs};
}

}  // namespace

Continued continued(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& point,
                    const FitSearchOptions& options, const RunContext& context) {
  FitMinimum filtered{point, follow(engine, point, {})};
  try {
    return through_filters(engine, unknowns, options, context, filtered);
  } catch (const OutOfTime&) {
    return {so_far(engine, unknowns, point, filtered.point)};
  }
}

}  // namespace lacuna
