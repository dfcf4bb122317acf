// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/bound_records.hpp"

#include <algorithm>
#include <utility>

#include "data/records/known_noise.hpp"
#include "lacuna/data/records/marks.hpp"
#include "records/channels/channel_notes.hpp"
#include "records/channels/interpolated.hpp"
#include "records/channels/kept_limits.hpp"
#include "records/channels/outliers.hpp"
#include "records/channels/repeats.hpp"

namespace lacuna {
namespace {

/// Of the values that have a value before them.
double fraction_of_repeats(const Dataset& data, Index state) {
  Index repeats = 0, steps = 0;
  for (const Trajectory& record : data.trajectories)
    for (Index i = 1; i < record.samples(); ++i) {
      if (mark_of(record.marks, i, state) != Mark::Value ||
          mark_of(record.marks, i - 1, state) != Mark::Value)
        continue;
      repeats += record.states(i, state) == record.states(i - 1, state) ? 1 : 0;
      ++steps;
    }
  return static_cast<double>(repeats) / static_cast<double>(std::max<Index>(1, steps));
}

double fraction_of(const Dataset& data, Index state, Mark mark) {
  Index count = 0;
  for (const Trajectory& record : data.trajectories)
    for (Index i = 0; i < record.samples(); ++i)
      count += mark_of(record.marks, i, state) == mark ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(data.samples());
}

/// The value of the samples at an end, if there are any.
std::optional<double> end_of(const Dataset& data, Index state, Mark mark) {
  for (const Trajectory& record : data.trajectories)
    for (Index i = 0; i < record.samples(); ++i)
      if (mark_of(record.marks, i, state) == mark) return record.states(i, state);
  return std::nullopt;
}

Channel channel_of(const Dataset& data, Index state, const StateNoise& noise) {
  return {.measured = data.is_measured(state),
          .noise = noise,
          .repeats = fraction_of_repeats(data, state),
          .missing = fraction_of(data, state, Mark::Missing),
          .at_top = fraction_of(data, state, Mark::AtTop),
          .at_bottom = fraction_of(data, state, Mark::AtBottom),
          .limits = {end_of(data, state, Mark::AtBottom), end_of(data, state, Mark::AtTop)}};
}

}  // namespace

BoundRecords observed(Dataset data, const ChannelOptions& options) {
  check_dataset(data);
  data = with_input_columns(std::move(data));
  const std::vector<Limits> limits = visible_limits(data, options.pile_up);
  data = with_interpolated_marked(with_repeats_marked(with_limits(std::move(data), limits)));
  BoundRecords records{std::move(data), {}, {}};
  const std::vector<StateNoise> noise = analyse_noise(records.data);
  for (Index k = 0; k < records.data.state_count(); ++k)
    records.channels.push_back(channel_of(records.data, k, noise[static_cast<std::size_t>(k)]));
  records.outliers = mark_outliers(records.data, noise, options.outlying);
  records.notes = channel_notes(records);
  return records;
}

BoundRecords observed_alike(Dataset data, const BoundRecords& records,
                            const ChannelOptions& options) {
  std::vector<Limits> limits;
  for (const Channel& channel : records.channels) limits.push_back(channel.limits);
  limits = limits_kept_by(data, std::move(limits));
  BoundRecords other = observed(with_limits(std::move(data), limits), options);
  bool any = false;
  for (std::size_t r = 0; r < other.outliers.size(); ++r) {
    Trajectory& record = other.data.trajectories[r];
    any = any || other.outliers[r] != marks_of(record);
    record.marks = other.outliers[r];
  }
  return any ? with_noise_anew(std::move(other)) : other;
}

BoundRecords as_measured(Dataset data, std::vector<Matrix> outliers) {
  BoundRecords records{std::move(data), {}, std::move(outliers)};
  for (Index k = 0; k < records.data.state_count(); ++k)
    records.channels.push_back({.measured = records.data.is_measured(k)});
  return with_noise_anew(std::move(records));
}

BoundRecords with_noise_anew(BoundRecords records) {
  check_dataset(records.data);
  const std::vector<StateNoise> noise = analyse_noise(records.data);
  for (std::size_t k = 0; k < records.channels.size(); ++k)
    records.channels[k].noise = noise[k];
  return records;
}

std::vector<StateNoise> noise_of(const BoundRecords& records) {
  std::vector<StateNoise> noise;
  for (const Channel& channel : records.channels) noise.push_back(channel.noise);
  return noise;
}

Vector visible_noise(const BoundRecords& records) {
  Vector visible = white_noise(noise_of(records));
  for (Index k = 0; k < visible.size(); ++k)
    if (const StateNoise& noise = records.channels[static_cast<std::size_t>(k)].noise;
        noise.kind == NoiseKind::Quantised)
      visible[k] = noise.sigma;
  return visible;
}

std::vector<double> coarse_lattices(const BoundRecords& records) {
  std::vector<double> lattices;
  for (const Channel& channel : records.channels) {
    const bool coarse = channel.measured && channel.noise.kind == NoiseKind::Quantised;
    lattices.push_back(coarse ? channel.noise.lattice.value_or(0.0) : 0.0);
  }
  return lattices;
}

bool mostly_repeats(const BoundRecords& records) {
  return std::any_of(
      records.channels.begin(), records.channels.end(),
      [](const Channel& channel) { return channel.measured && channel.repeats > 0.5; });
}

}  // namespace lacuna
