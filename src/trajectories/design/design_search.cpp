// SPDX-License-Identifier: MIT
#include "design_search.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/base/parallel.hpp"
#include "core/base/random.hpp"
#include "forms/candidate/shape_search.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// A fraction of the numbers of every second candidate is at an end of its range.
constexpr double kAtEnds = 0.7;

Vector random_design(Index size, bool at_ends, Random& random) {
  Vector design(size);
  for (double& value : design) {
    value = random.uniform();
    if (at_ends && random.uniform() < kAtEnds) value = value < 0.5 ? 0.0 : 1.0;
  }
  return design;
}

std::vector<ScoredDesign> candidates_of(const std::vector<Index>& sizes, int count,
                                        std::uint64_t seed) {
  Random random(seed);
  std::vector<ScoredDesign> candidates;
  for (std::size_t space = 0; space < sizes.size(); ++space)
    for (int i = 0; i < (sizes[space] == 0 ? 1 : count); ++i)
      candidates.push_back({space, random_design(sizes[space], i % 2 == 1, random)});
  return candidates;
}

constexpr double kUnscored = -std::numeric_limits<double>::infinity();

/// @return whether all were scored before the deadline; others are kUnscored.
bool score_all(std::vector<ScoredDesign>& designs, const std::function<Score()>& make_score,
               const RunContext& context) {
  constexpr std::size_t kLane = 16;  // designs that share a scorer
  std::atomic<bool> in_time{true};
  for (ScoredDesign& one : designs) one.score = kUnscored;
  const std::size_t lanes = (designs.size() + kLane - 1) / kLane;
  parallel_for(lanes, context.threads, [&](std::size_t lane) {
    const Score score = make_score();
    for (std::size_t i = lane * kLane; i < std::min(designs.size(), (lane + 1) * kLane); ++i) {
      if (context.is_late()) in_time = false;
      if (!in_time) return;
      context.check_stop();
      designs[i].score = score(designs[i].space, designs[i].design);
    }
  });
  return in_time;
}

void sort_by_score(std::vector<ScoredDesign>& designs) {
  std::stable_sort(
      designs.begin(), designs.end(),
      [](const ScoredDesign& a, const ScoredDesign& b) { return a.score > b.score; });
}

/// The best ones, but no more than half of them of one space, so that a family that is better
/// once improved has its chance.
std::vector<ScoredDesign> chosen(std::vector<ScoredDesign> all, std::size_t spaces,
                                 std::size_t count) {
  sort_by_score(all);
  const std::size_t most = spaces > 1 ? (count + 1) / 2 : count;
  std::vector<ScoredDesign> best;
  std::vector<std::size_t> of_space(spaces, 0);
  for (ScoredDesign& one : all) {
    if (best.size() == count) break;
    if (of_space[one.space] == most) continue;
    ++of_space[one.space];
    best.push_back(std::move(one));
  }
  return best;
}

ScoredDesign improved(ScoredDesign start, const Score& score, int evaluations) {
  if (start.design.size() == 0) return start;
  ScoredDesign best = exchanged(std::move(start), score, evaluations / 2);
  // A decision: a design has more numbers than Nelder and Mead's method is good for, and changes
  // by a seventh of their ranges are what the exchange before has left open.
  constexpr double kFirstStep = 0.15;
  best.design = least_in_cube(
      [&](const Vector& design) { return -score(best.space, design); }, best.design,
      {.reach = kFirstStep,
       .evaluations = evaluations - evaluations / 2,
       .method = CubeMethod::Sbplx});
  best.score = score(best.space, best.design);
  return best;
}

/// The same; past the deadline the best one on the way.
/// @return whether the search came to its end.
bool improve(ScoredDesign& design, const Score& score, int evaluations,
             const RunContext& context) {
  ScoredDesign best = design;
  const Score watched = [&](std::size_t space, const Vector& other) {
    context.check_stop();
    const double value = score(space, other);
    if (value > best.score) best = {space, other, value};
    return value;
  };
  try {
    design = improved(std::move(design), watched, evaluations);
  } catch (const OutOfTime&) {
    design = std::move(best);
    return false;
  }
  return true;
}

}  // namespace

ScoredDesign exchanged(ScoredDesign start, const Score& score, int evaluations) {
  constexpr std::array<double, 3> kPlaces{0.0, 1.0, 0.5};
  const Index size = start.design.size();
  Index unchanged = 0;
  for (Index i = 0; unchanged < size && evaluations > 0; i = (i + 1) % size) {
    ++unchanged;
    for (const double place : kPlaces) {
      if (start.design[i] == place || evaluations == 0) continue;
      ScoredDesign other = start;
      other.design[i] = place;
      other.score = score(other.space, other.design);
      --evaluations;
      if (!(other.score > start.score)) continue;
      start = std::move(other);
      unchanged = 0;
    }
  }
  return start;
}

SearchedDesigns best_designs(const std::vector<Index>& sizes,
                             const std::function<Score()>& make_score,
                             const std::vector<ScoredDesign>& known, const DesignSearch& search,
                             const RunContext& context) {
  context.report("judging designs", 0.0);
  std::vector<ScoredDesign> all = candidates_of(sizes, search.candidates, context.seed);
  all.insert(all.end(), known.begin(), known.end());
  std::atomic<bool> in_time{score_all(all, make_score, context)};
  SearchedDesigns found;
  found.best = chosen(std::move(all), sizes.size(), static_cast<std::size_t>(search.searches));
  if (!in_time && !std::isfinite(found.best.front().score)) throw OutOfTime();
  if (in_time) context.unhurried().report("improving designs", 0.3);
  parallel_for(in_time ? found.best.size() : 0, context.threads, [&](std::size_t i) {
    if (!improve(found.best[i], make_score(), search.evaluations, context)) in_time = false;
  });
  sort_by_score(found.best);
  found.in_time = in_time;
  return found;
}

}  // namespace lacuna
