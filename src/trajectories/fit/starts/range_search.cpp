// SPDX-License-Identifier: MIT
#include "range_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "other_starts.hpp"

namespace lacuna {
namespace {

constexpr int kRound = 10;       // starts of a round: a decision
constexpr int kDraws = 5;        // of which a start is the best: they cost less than one step each
constexpr int kFirstSteps = 20;  // after which the better half of a round goes on: a decision

/// The best of some points by its likelihood; nothing where no run is finite.
std::optional<FitMinimum> best_of(FitEngine& engine, const FitUnknowns& unknowns,
                                  const std::vector<FitPoint>& points, std::size_t first,
                                  std::size_t count) {
  std::optional<FitMinimum> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < std::min(first + count, points.size()); ++i) {
    FitMinimum one{points[i], follow(engine, points[i], {})};
    const double deviance = deviance_of(engine, unknowns, one);
    if (!(deviance < least)) continue;
    least = deviance;
    best = std::move(one);
  }
  return best;
}

/// A search that has made its first steps.
struct Begun {
  FitMinimum minimum;
  double deviance = 0.0;
};

/// The first steps from the best of the draws of a start; nothing where it has no finite run.
std::optional<Begun> first_steps(FitEngine& engine, const FitUnknowns& unknowns,
                                 const std::vector<FitPoint>& points, int start,
                                 const RunContext& context) {
  const auto best =
      best_of(engine, unknowns, points, static_cast<std::size_t>(kDraws * start), kDraws);
  if (!best) return std::nullopt;
  Begun one{minimise(engine, unknowns, best->point, {}, kFirstSteps, context)};
  one.deviance = deviance_of(engine, unknowns, one.minimum);
  return one;
}

}  // namespace

bool is_settled(std::vector<double> deviances, double alike) {
  // A decision: two that agree may both be in a minimum that is wide and wrong.
  constexpr int kReached = 3;
  std::sort(deviances.begin(), deviances.end());
  if (deviances.empty()) return false;
  double different = 1.0;
  for (std::size_t i = 1; i < deviances.size(); ++i)
    if (deviances[i] > deviances[i - 1] + alike) ++different;
  const auto reached = std::count_if(deviances.begin(), deviances.end(), [&](double one) {
    return one <= deviances.front() + alike;
  });
  const double searches = static_cast<double>(deviances.size()),
               free = searches - different - 2.0;
  return reached >= kReached && free > 0.0 &&
         different * (searches - 1.0) / free - different < 1.0;
}

bool search_ranges(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                   const FitSearchOptions& options, const RunContext& context,
                   FunctionRef<void(FitMinimum)> found, FunctionRef<void()> ended) {
  const Vector sigma = engine.sigma;
  const auto laws = engine.laws;
  const int count = options.range_starts;
  Random random(context.seed);
  const std::vector<FitPoint> points =
      starts_over_ranges(engine, unknowns, start, kDraws * count, options.spread, random);
  std::vector<double> deviances;
  for (int first = 0; first < count; first += kRound) {
    context.report("trying starts over the ranges",
                   static_cast<double>(first) / static_cast<double>(count));
    std::vector<Begun> begun;
    for (int i = first; i < std::min(first + kRound, count); ++i)
      if (auto one = first_steps(engine, unknowns, points, i, context))
        begun.push_back(std::move(*one));
      else
        ended();
    std::stable_sort(begun.begin(), begun.end(),
                     [](const Begun& a, const Begun& b) { return a.deviance < b.deviance; });
    for (std::size_t i = 0; i < begun.size(); ++i) {
      deviances.push_back(begun[i].deviance);
      if (2 * i >= begun.size() + 1) {
        ended();
        continue;
      }
      FitMinimum minimum =
          reweighted(engine, unknowns, std::move(begun[i].minimum), options, context);
      engine.sigma = sigma;
      engine.laws = laws;
      if (!minimum.in_time) throw OutOfTime();
      deviances.back() = deviance_of(engine, unknowns, minimum);
      found(std::move(minimum));
    }
    if (is_settled(deviances, kAlike * engine.records.valid.sum())) return true;
  }
  return false;
}

}  // namespace lacuna
