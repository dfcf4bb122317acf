// SPDX-License-Identifier: MIT
#include "record_stretches.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// @param fraction of the samples that are taken.
void add_stretches(const Trajectory& record, Index length, double fraction, Dataset& result) {
  const Index n = record.samples();
  const double wanted = fraction * static_cast<double>(n);
  const auto count = std::max<Index>(1, std::llround(wanted / static_cast<double>(length)));
  if (n <= 2 * count * length) return result.trajectories.push_back(record);
  for (Index i = 0; i < count; ++i)  // in the middle of equal parts
    result.trajectories.push_back(
        rows_of(record, (2 * i + 1) * n / (2 * count) - length / 2, length));
}

}  // namespace

Dataset record_stretches(const Dataset& data, Index most, Index window) {
  // Facts of the statistic: all parts of a long record are seen, each by several windows.
  constexpr Index kStretches = 16, kWindows = 8;
  const Index all = data.samples();
  if (all <= 2 * most) return data;
  Dataset result{data.time_unit, data.states,        data.inputs, {},
                 data.rate_of,   data.reconstructed, data.notes};
  const Index length = std::min(most, std::max(most / kStretches, kWindows * window));
  const double fraction = static_cast<double>(most) / static_cast<double>(all);
  for (const Trajectory& record : data.trajectories)
    add_stretches(record, length, fraction, result);
  return result;
}

}  // namespace lacuna
