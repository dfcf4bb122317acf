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

/// Samples of one state of a record that are values, upside down where its lower end is looked
/// for.
struct Piece {
  Vector values;
  std::vector<Index> samples;  ///< of the record
};

std::vector<Piece> pieces_of(const Dataset& data, Index state, double side) {
  std::vector<Piece> pieces;
  for (const Trajectory& record : data.trajectories) {
    std::vector<Index> samples;
    for (Index i = 0; i < record.samples(); ++i)
      if (mark_of(record.marks, i, state) == Mark::Value) samples.push_back(i);
    pieces.push_back({side * record.states.col(state)(samples), std::move(samples)});
  }
  return pieces;
}

/// How many samples have each value.
std::map<double, Index> counted(const std::vector<Piece>& pieces) {
  std::map<double, Index> counts;
  for (const Piece& piece : pieces)
    for (const double value : piece.values) ++counts[value];
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

/// A sample of a record.
struct Sample {
  const Trajectory* record = nullptr;
  Index row = 0;
};

/// Whether inputs and the other measured states have the same values in two samples; false
/// where there are none.
bool others_agree(const Dataset& data, Index state, const Sample& a, const Sample& b) {
  bool any = data.input_count() > 0;
  if (any && a.record->inputs.row(a.row) != b.record->inputs.row(b.row)) return false;
  for (Index k = 0; k < data.state_count(); ++k) {
    if (k == state || !data.is_measured(k)) continue;
    any = true;
    if (a.record->states(a.row, k) != b.record->states(b.row, k)) return false;
  }
  return any;
}

/// Samples first ... first + count - 1 of a piece, all at the end.
struct Stay {
  std::size_t piece = 0;
  Index first = 0, count = 0;

  bool is_begin() const { return first == 0; }  ///< of the record, so how it came is not seen
};

/// The stays at the end.
std::vector<Stay> stays_at(const std::vector<Piece>& pieces, double end) {
  std::vector<Stay> stays;
  for (std::size_t r = 0; r < pieces.size(); ++r) {
    const Vector& values = pieces[r].values;
    for (Index i = 0; i < values.size(); ++i) {
      if (values[i] != end) continue;
      if (i == 0 || values[i - 1] != end) stays.push_back({r, i, 0});
      ++stays.back().count;
    }
  }
  return stays;
}

/// Samples at the end that are no rest. Where a record begins there while all else rests, the
/// value is one at which the system rests, to which it may come back: then only samples count in
/// which something else has another value than there.
Index samples_at_end(const Dataset& data, Index state, const std::vector<Piece>& pieces,
                     const std::vector<Stay>& stays) {
  const auto sample = [&](const Stay& stay, Index i) {
    const auto row = static_cast<std::size_t>(stay.first + i);
    return Sample{&data.trajectories[stay.piece], pieces[stay.piece].samples[row]};
  };
  const auto rest = std::find_if(stays.begin(), stays.end(), [&](const Stay& stay) {
    return stay.is_begin() && stay.count > 1 &&
           others_agree(data, state, sample(stay, 0), sample(stay, 1));
  });
  Index samples = 0;
  for (const Stay& stay : stays)
    for (Index i = 0; i < stay.count && !stay.is_begin(); ++i)
      samples += rest == stays.end() ||
                 !others_agree(data, state, sample(*rest, 0), sample(stay, i));
  return samples;
}

/// Steps by which the samples come to the end and leave it.
std::vector<double> steps_at(const std::vector<Piece>& pieces, const std::vector<Stay>& stays) {
  std::vector<double> steps;
  for (const Stay& stay : stays) {
    if (stay.is_begin()) continue;
    const Vector& values = pieces[stay.piece].values;
    const Index behind = stay.first + stay.count;
    steps.push_back(std::abs(values[stay.first] - values[stay.first - 1]));
    if (behind < values.size()) steps.push_back(std::abs(values[behind] - values[behind - 1]));
  }
  return steps;
}

/// Whether the signal comes to its end at its speed: most steps there are many of the lattice.
bool comes_at_speed(std::vector<double> steps, double spacing) {
  constexpr double kMany = 3.0;
  if (steps.empty()) return false;
  return upper_median(std::move(steps)) > kMany * spacing;
}

/// The largest value where samples pile up there. @param spacing of the values.
std::optional<double> upper_end(const Dataset& data, Index state,
                                const std::vector<Piece>& pieces, double spacing,
                                double pile_up) {
  const std::map<double, Index> counts = counted(pieces);
  if (counts.size() < 3) return std::nullopt;
  const auto [end, count] = *counts.rbegin();
  const auto enough = pile_up * static_cast<double>(std::max<Index>(1, most_beside(counts)));
  if (static_cast<double>(count) <= enough) return std::nullopt;
  const std::vector<Stay> stays = stays_at(pieces, end);
  const Index there = samples_at_end(data, state, pieces, stays);
  if (static_cast<double>(there) <= enough) return std::nullopt;
  if (!comes_at_speed(steps_at(pieces, stays), spacing)) return std::nullopt;
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
    found.high = upper_end(data, k, pieces_of(data, k, 1.0), spacings[k], pile_up);
    found.low = upper_end(data, k, pieces_of(data, k, -1.0), spacings[k], pile_up);
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
