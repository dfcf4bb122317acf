// SPDX-License-Identifier: MIT
#include "channel_notes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

std::string with_unit(double value, const Quantity& state) {
  return format_number(value, 3) + (state.unit.empty() ? "" : " " + state.unit);
}

std::string clipped_note(const Quantity& state, const Channel& channel) {
  std::vector<std::string> ends;
  if (channel.limits.high)
    ends.push_back("at " + with_unit(*channel.limits.high, state) + ": " +
                   percent(channel.at_top) + " of the samples");
  if (channel.limits.low)
    ends.push_back("at " + with_unit(*channel.limits.low, state) + ": " +
                   percent(channel.at_bottom) + " of the samples");
  return "clipped-channel: " + state.name + " is clipped " + join(ends, ", ") +
         "; they count as 'at least' or 'at most' so much";
}

std::string missing_note(const Quantity& state, const Channel& channel) {
  return "dropouts: " + percent(channel.missing) + " of the samples of " + state.name +
         " are blank, repeat the last value or lie on lines between others; they are left out";
}

/// Span of the values of a state.
double span_of(const Dataset& data, Index state) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Trajectory& record : data.trajectories) {
    low = std::min(low, record.states.col(state).minCoeff());
    high = std::max(high, record.states.col(state).maxCoeff());
  }
  return high - low;
}

/// Rounding is worth a word where it is a part of the noise, and coarser than 12 bits of the
/// span: what is finer are the digits of the file.
std::string quantised_note(const Quantity& state, const Channel& channel, double span) {
  constexpr double kLevels = 4096.0;
  constexpr double kPart = 0.3;  // of the deviation: a tenth of the variance
  const double step = channel.noise.lattice.value_or(0.0);
  const bool is_part = step / std::sqrt(12.0) > kPart * channel.noise.sigma;
  if (!is_part || !(step * kLevels > span)) return "";
  return "the channel " + state.name + " is quantised: its values lie on a lattice of " +
         with_unit(step, state) + " (resolution of " +
         format_number(std::ceil(std::log2(span / step + 1.0)), 2) +
         " bits), and rounding is " +
         (channel.noise.kind == NoiseKind::Quantised ? "its noise" : "a part of its noise");
}

}  // namespace

std::vector<std::string> channel_notes(const BoundRecords& records) {
  std::vector<std::string> notes;
  for (std::size_t k = 0; k < records.channels.size(); ++k) {
    const Channel& channel = records.channels[k];
    const Quantity& state = records.data.states[k];
    if (!channel.measured) continue;
    if (channel.limits.high || channel.limits.low)
      notes.push_back(clipped_note(state, channel));
    if (channel.missing > 0.0) notes.push_back(missing_note(state, channel));
    const double span = span_of(records.data, static_cast<Index>(k));
    if (std::string note = quantised_note(state, channel, span); !note.empty())
      notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace lacuna
