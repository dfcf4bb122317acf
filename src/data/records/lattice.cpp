// SPDX-License-Identifier: MIT
#include "lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

/// All values of a state that are different, in order; of records that have two or more.
std::vector<double> distinct_values(const Dataset& data, Index state) {
  std::vector<double> values;
  for (const Trajectory& record : data.trajectories) {
    const Matrix column = values_of(record, state).states;
    if (column.rows() >= 2)
      values.insert(values.end(), column.data(), column.data() + column.size());
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

std::optional<double> lattice_of(const Dataset& data, Index state) {
  constexpr std::size_t kFewestLevels = 8;  // fewer say nothing of what they have in common
  constexpr double kRounding = 1e-3;        // of a multiple, as a fraction of q
  constexpr double kMostLevels = 67108864;  // 2^26: finer lattices are decimal digits
  const std::vector<double> values = distinct_values(data, state);
  if (values.size() < kFewestLevels) return std::nullopt;
  std::vector<double> gaps(values.size() - 1);
  for (std::size_t i = 0; i < gaps.size(); ++i) gaps[i] = values[i + 1] - values[i];
  std::sort(gaps.begin(), gaps.end());
  const double smallest = (values.back() - values.front()) / kMostLevels;
  double spacing = gaps.front();
  for (std::size_t i = 1; i < gaps.size() && spacing > smallest; ++i) {
    // Euclid's algorithm on the gaps.
    double rest = std::abs(std::remainder(gaps[i], spacing));
    const double limit = kRounding * spacing;
    if (rest <= limit) spacing = gaps[i] / std::round(gaps[i] / spacing);
    while (rest > limit) {
      const double next = std::abs(std::remainder(spacing, rest));
      spacing = rest;
      rest = next;
    }
  }
  if (!(spacing > smallest)) return std::nullopt;
  return spacing;
}

}  // namespace lacuna
