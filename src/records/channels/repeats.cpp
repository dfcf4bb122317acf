// SPDX-License-Identifier: MIT
#include "repeats.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "lacuna/data/records/marks.hpp"
#include "lacuna/data/records/noise.hpp"
#include "value_spacing.hpp"

namespace lacuna {
namespace {

/// Samples first + 1 ... first + count that are as the one before them.
struct Run {
  std::size_t record = 0;
  Index first = 0;
  Index count = 0;
};

bool repeats(const Trajectory& record, Index state, Index i) {
  return mark_of(record.marks, i, state) == Mark::Value &&
         mark_of(record.marks, i - 1, state) == Mark::Value &&
         record.states(i, state) == record.states(i - 1, state);
}

std::vector<Run> runs_of(const Dataset& data, Index state) {
  std::vector<Run> runs;
  for (std::size_t r = 0; r < data.trajectories.size(); ++r) {
    const Trajectory& record = data.trajectories[r];
    for (Index i = 1; i < record.samples(); ++i) {
      if (!repeats(record, state, i)) continue;
      if (runs.empty() || runs.back().record != r ||
          runs.back().first + runs.back().count + 1 != i)
        runs.push_back({r, i - 1, 0});
      ++runs.back().count;
    }
  }
  return runs;
}

void mark(const std::vector<Run>& runs, Index state, Index shortest, Dataset& data) {
  for (const Run& run : runs)
    for (Index i = 1; i <= run.count && run.count >= shortest; ++i)
      set_mark(data.trajectories[run.record], run.first + i, state, Mark::Missing);
}

/// One state and its marks, without the others: they may be many.
Dataset one_state(const Dataset& data, Index state) {
  Dataset only;
  only.states = {data.states[static_cast<std::size_t>(state)]};
  for (const Trajectory& record : data.trajectories) {
    Trajectory one;
    one.time = record.time;
    one.states = record.states.col(state);
    if (record.marks.size() > 0) one.marks = record.marks.col(state);
    only.trajectories.push_back(std::move(one));
  }
  return only;
}

/// Chance that the noise of a state lets a value come twice; 1 where no noise is seen.
double chance_of_repeat(const Dataset& data, Index state, const std::vector<Run>& runs) {
  Dataset changes = one_state(data, state);
  mark(runs, 0, 1, changes);
  Dataset values;
  values.states = changes.states;
  for (const Trajectory& record : changes.trajectories)
    if (Trajectory some = values_of(record, 0); some.samples() >= 2)
      values.trajectories.push_back(std::move(some));
  const StateNoise noise = analyse_noise(values).front();
  if (noise.kind != NoiseKind::White && noise.kind != NoiseKind::Coloured) return 1.0;
  const double spacing = std::max(value_spacings(values)[0], gap_of_visited(values, 0));
  return spacing / (2.0 * std::sqrt(M_PI) * noise.sigma);
}

/// Number of repeats from which on a run is hardly chance; 0 where none is.
Index shortest_of(const std::vector<Run>& runs, double chance, double samples) {
  constexpr double kByChance = 0.05;
  constexpr double kLikely = 0.1;  // from where on the lattice is as coarse as the noise
  constexpr auto kFewest = 3;
  if (chance > kLikely) return 0;
  Index longest = 0;
  for (const Run& run : runs) longest = std::max(longest, run.count);
  for (Index r = 1; r <= longest; ++r) {
    const auto found =
        std::count_if(runs.begin(), runs.end(), [&](const Run& run) { return run.count >= r; });
    const double by_chance = samples * std::pow(chance, static_cast<double>(r));
    if (found >= kFewest && by_chance < kByChance * static_cast<double>(found)) return r;
  }
  return 0;
}

/// Whether all changes are whole multiples of several samples apart.
bool is_regular(const std::vector<Run>& runs) {
  constexpr std::size_t kFewest = 20;
  if (runs.size() < kFewest) return false;
  Index common = 0;
  for (std::size_t i = 1; i < runs.size(); ++i)
    if (runs[i].record == runs[i - 1].record)
      common = std::gcd(common, runs[i].first - runs[i - 1].first);
  for (std::size_t i = 0; i + 1 < runs.size(); ++i)
    if (runs[i].record == runs[i + 1].record) common = std::gcd(common, runs[i].count + 1);
  return common > 1;
}

}  // namespace

Dataset with_repeats_marked(Dataset data) {
  for (Index k = 0; k < data.state_count(); ++k) {
    if (!data.is_measured(k)) continue;
    const std::vector<Run> runs = runs_of(data, k);
    if (runs.empty()) continue;
    Index shortest = 1;
    if (!is_regular(runs))
      shortest = shortest_of(runs, chance_of_repeat(data, k, runs),
                             static_cast<double>(data.samples()));
    if (shortest > 0) mark(runs, k, shortest, data);
  }
  return data;
}

}  // namespace lacuna
