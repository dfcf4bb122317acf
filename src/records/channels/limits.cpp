// SPDX-License-Identifier: MIT
#include "lacuna/records/channels/limits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/statistics/robust_statistics.hpp"
#include "data/records/check_record.hpp"
#include "lacuna/data/records/marks.hpp"
#include "value_spacing.hpp"

namespace lacuna {
namespace {

/// Samples of one state that are values, upside down where its lower end is looked for.
std::vector<Vector> pieces_of(const Dataset& data, Index state, double side) {
  std::vector<Vector> pieces;
  for (const Trajectory& record : data.trajectories)
    pieces.push_back(side * values_of(record, state).states.col(0));
  return pieces;
}

/// How many samples have each value.
std::map<double, Index> counted(const std::vector<Vector>& pieces) {
  std::map<double, Index> counts;
  for (const Vector& piece : pieces)
    for (const double value : piece) ++counts[value];
  return counts;
}

/// Most samples that have one of the values next to the largest.
Index most_beside(const std::map<double, Index>& counts) {
  constexpr int kBeside = 10;
  Index most = 0;
  auto next = std::next(counts.rbegin());
  for (int i = 0; i < kBeside && next != counts.rend(); ++i, ++next)
    most = std::max(most, next->second);
  return most;
}

/// Steps by which the samples come to the end and leave it.
std::vector<double> steps_at(const std::vector<Vector>& pieces, double end) {
  std::vector<double> steps;
  for (const Vector& piece : pieces)
    for (Index i = 1; i < piece.size(); ++i)
      if ((piece[i] == end) != (piece[i - 1] == end))
        steps.push_back(std::abs(piece[i] - piece[i - 1]));
  return steps;
}

/// Whether the signal comes to its end at its speed: most steps there are many of the lattice.
bool comes_at_speed(std::vector<double> steps, double spacing) {
  constexpr double kMany = 3.0;
  if (steps.empty()) return false;
  return upper_median(std::move(steps)) > kMany * spacing;
}

/// The largest value where samples pile up there. @param spacing of the values.
std::optional<double> upper_end(const std::vector<Vector>& pieces, double spacing,
                                double pile_up) {
  const std::map<double, Index> counts = counted(pieces);
  if (counts.size() < 3) return std::nullopt;
  const auto [end, count] = *counts.rbegin();
  const auto most = static_cast<double>(std::max<Index>(1, most_beside(counts)));
  if (static_cast<double>(count) <= pile_up * most) return std::nullopt;
  if (!comes_at_speed(steps_at(pieces, end), spacing)) return std::nullopt;
  return end;
}

void mark(Trajectory& record, Index state, const Limits& limits) {
  for (Index i = 0; i < record.samples(); ++i) {
    if (mark_of(record.marks, i, state) != Mark::Value) continue;
    double& value = record.states(i, state);
    if (limits.high && value >= *limits.high) {
      set_mark(record, i, state, Mark::AtTop);
      value = *limits.high;
    } else if (limits.low && value <= *limits.low) {
      set_mark(record, i, state, Mark::AtBottom);
      value = *limits.low;
    }
  }
}

}  // namespace

std::vector<Limits> visible_limits(const Dataset& data, double pile_up) {
  std::vector<Limits> limits(static_cast<std::size_t>(data.state_count()));
  check_states(data, "visible_limits");
  const Vector spacings = value_spacings(data);
  for (Index k = 0; k < data.state_count(); ++k) {
    if (!data.is_measured(k)) continue;
    Limits& found = limits[static_cast<std::size_t>(k)];
    found.high = upper_end(pieces_of(data, k, 1.0), spacings[k], pile_up);
    found.low = upper_end(pieces_of(data, k, -1.0), spacings[k], pile_up);
    if (found.low) found.low = -*found.low;
  }
  return limits;
}

Dataset with_limits(Dataset data, const std::vector<Limits>& limits) {
  check_columns(data, "with_limits");
  check_argument(limits.size() == data.states.size(), "with_limits",
                 "there are not limits for each state");
  for (Trajectory& record : data.trajectories)
    for (std::size_t k = 0; k < limits.size(); ++k)
      mark(record, static_cast<Index>(k), limits[k]);
  return data;
}

}  // namespace lacuna
