// SPDX-License-Identifier: MIT
#include "records/channels/interpolated.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "data/records/check_record.hpp"
#include "lacuna/data/records/marks.hpp"
#include "value_spacing.hpp"

namespace lacuna {
namespace {

/// Whether a sample is on the line between its neighbours, up to the rounding of three numbers;
/// what is held from step to step is on none.
bool is_on_line(const Vector& time, const Eigen::Ref<const Vector>& values, Index i,
                double spacing) {
  const double fraction = (time[i] - time[i - 1]) / (time[i + 1] - time[i - 1]);
  const double line = values[i - 1] + fraction * (values[i + 1] - values[i - 1]);
  return std::abs(values[i] - line) <= spacing &&
         std::abs(values[i + 1] - values[i - 1]) > 2.0 * spacing;
}

/// Samples first ... first + count - 1 on one line.
struct Stretch {
  Index first = 0, count = 0;
};

std::vector<Stretch> stretches_of(const Vector& time, const Eigen::Ref<const Vector>& values,
                                  double spacing) {
  std::vector<Stretch> stretches;
  for (Index i = 1; i + 1 < time.size(); ++i) {
    if (!is_on_line(time, values, i, spacing)) continue;
    if (stretches.empty() || stretches.back().first + stretches.back().count != i)
      stretches.push_back({i, 0});
    ++stretches.back().count;
  }
  return stretches;
}

/// Whether stretches begin whole multiples of so many samples apart that one of them has room,
/// and are as much of the record as lines leave.
/// Two lines in a row may be one: where the signal is straight, or rests; the first may have
/// begun before the record.
bool are_regular(const std::vector<Stretch>& stretches, Index samples) {
  // Facts: so many begin even numbers of samples apart by chance once in half a million; and of
  // three samples between two measured at other times one is on the line, less at the ends.
  constexpr std::size_t kFewest = 20;
  constexpr double kLeastFraction = 0.3;
  if (stretches.size() < kFewest) return false;
  Index period = 0, shortest = stretches.front().count, all = stretches.front().count;
  for (std::size_t i = 1; i < stretches.size(); ++i) {
    if (i > 1) period = std::gcd(period, stretches[i].first - stretches[i - 1].first);
    shortest = std::min(shortest, stretches[i].count);
    all += stretches[i].count;
  }
  return shortest < period &&
         static_cast<double>(all) >= kLeastFraction * static_cast<double>(samples);
}

}  // namespace

std::vector<Index> interpolated_samples(const Vector& time,
                                        const Eigen::Ref<const Vector>& values,
                                        double spacing) {
  check_argument(values.size() == time.size(), "interpolated_samples",
                 "times and values differ in number", "give one value for each time");
  const std::vector<Stretch> stretches = stretches_of(time, values, spacing);
  std::vector<Index> samples;
  if (!are_regular(stretches, time.size())) return samples;
  for (const Stretch& stretch : stretches)
    for (Index i = 0; i < stretch.count; ++i) samples.push_back(stretch.first + i);
  return samples;
}

std::vector<Index> interpolated_samples(const Trajectory& record, Index input) {
  check_rows(record, "interpolated_samples");
  check_number(input, record.inputs.cols(), "interpolated_samples", "input");
  const auto values = record.inputs.col(input);
  return interpolated_samples(record.time, values, spacing_of_digits(values));
}

bool is_interpolated(const Dataset& data, Index input) {
  return std::any_of(
      data.trajectories.begin(), data.trajectories.end(),
      [&](const Trajectory& record) { return !interpolated_samples(record, input).empty(); });
}

Dataset with_interpolated_marked(Dataset data) {
  check_states(data, "with_interpolated_marked");
  const Vector spacings = value_spacings(data);
  for (Trajectory& record : data.trajectories)
    for (Index k = 0; k < data.state_count(); ++k) {
      if (!data.is_measured(k)) continue;
      for (const Index i : interpolated_samples(record.time, record.states.col(k), spacings[k]))
        if (mark_of(record.marks, i, k) == Mark::Value) set_mark(record, i, k, Mark::Missing);
    }
  return data;
}

}  // namespace lacuna
