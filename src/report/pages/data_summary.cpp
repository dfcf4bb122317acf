// SPDX-License-Identifier: MIT
#include "report/pages/data_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/attractor/power_spectrum.hpp"
#include "records/channels/shown_holds.hpp"

namespace lacuna {
namespace {

RecordSummary summary_of(const Trajectory& record) {
  return {record.source,
          record.samples(),
          record.time[0],
          record.time[record.samples() - 1],
          record.samples() > 1 ? mean_step(record) : 0.0,
          uniform_step(record).has_value()};
}

/// Least and largest value of a column over all records.
template <class Column>
ChannelSummary with_range(ChannelSummary channel, const Dataset& data, Column column) {
  channel.least = std::numeric_limits<double>::infinity();
  channel.largest = -channel.least;
  for (const Trajectory& record : data.trajectories) {
    channel.least = std::min(channel.least, column(record).minCoeff());
    channel.largest = std::max(channel.largest, column(record).maxCoeff());
  }
  return channel;
}

/// Highest frequency at which the longest record shows more than noise.
std::optional<double> signal_until(const Dataset& data, Index state, double sigma) {
  constexpr double kAbove = 4.0;  // times the noise: chance alone gives that to no frequency
  constexpr Index kSegments = 16;
  const Trajectory& record = longest_record(data);
  const auto step = uniform_step(record);
  if (!step || !(sigma > 0.0) || record.samples() < 16 * kSegments) return std::nullopt;
  Trajectory one = record;
  one.states = record.states.col(state).eval();
  const PowerSpectrum spectrum = power_spectrum(one, kSegments);
  const double floor = kAbove * 2.0 * *step * sigma * sigma;
  for (Index f = spectrum.frequency.size() - 1; f > 0; --f)
    if (spectrum.density(f, 0) > floor) return spectrum.frequency[f];
  return 0.0;
}

}  // namespace

DataSummary summarise(const Dataset& data, Index known) {
  const BoundRecords bound = observed(data);
  DataSummary summary{data.time_unit, {}, {}, {}, data.notes};
  for (const Trajectory& record : data.trajectories)
    summary.records.push_back(summary_of(record));
  for (Index k = 0; k < data.state_count(); ++k) {
    const Channel& channel = bound.channels[static_cast<std::size_t>(k)];
    if (is_hidden(data, k)) {
      summary.channels.push_back({data.states[static_cast<std::size_t>(k)], "not measured"});
      continue;
    }
    ChannelSummary state{data.states[static_cast<std::size_t>(k)], "state", 0.0, 0.0, channel};
    if (channel.noise.kind != NoiseKind::None)
      state.signal_until = signal_until(bound.data, k, channel.noise.sigma);
    summary.channels.push_back(with_range(
        std::move(state), data, [&](const Trajectory& r) { return r.states.col(k); }));
  }
  for (Index j = 0; j < data.input_count(); ++j) {
    ChannelSummary input{data.inputs[static_cast<std::size_t>(j)],
                         j < known ? "input" : "not used"};
    input.hold = shown_hold(data, j);
    summary.channels.push_back(with_range(
        std::move(input), data, [&](const Trajectory& r) { return r.inputs.col(j); }));
  }
  summary.notes.insert(summary.notes.end(), bound.notes.begin(), bound.notes.end());
  return summary;
}

}  // namespace lacuna
