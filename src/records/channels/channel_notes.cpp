// SPDX-License-Identifier: MIT
#include "channel_notes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/text.hpp"
#include "core/statistics/robust_statistics.hpp"
#include "data/records/split.hpp"
#include "lacuna/data/records/marks.hpp"

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

/// Times from row to row, of one state from each sample that is not missing to the next.
struct RowSteps {
  std::vector<double> steps;
  double usual = 0.0;
  std::optional<double> gap;  ///< above which a step has a gap (gap_threshold())

  /// Whether nearly all steps are alike: nothing else has a gap of less than two.
  bool is_even() const { return gap && *gap < 2.0 * usual; }
};

RowSteps row_steps(const Dataset& data, std::optional<Index> state) {
  RowSteps rows;
  for (const Trajectory& record : data.trajectories) {
    std::optional<double> last;
    for (Index i = 0; i < record.samples(); ++i) {
      if (state && mark_of(record.marks, i, *state) == Mark::Missing) continue;
      if (last) rows.steps.push_back(record.time[i] - *last);
      last = record.time[i];
    }
  }
  if (!rows.steps.empty()) rows.usual = median(rows.steps);
  rows.gap = gap_threshold(rows.steps);
  return rows;
}

/// The part of its samples that a channel lacks. Rows at times of others, as of another file or
/// a faster sensor, lack nothing: there the gaps in its own sampling count.
/// @param missing part of all rows.
double lacking(const Dataset& data, Index state, double missing) {
  const RowSteps all = row_steps(data, std::nullopt), own = row_steps(data, state);
  if (!own.gap) return missing;
  // Among rows at even times only even steps of several rows are a channel's own.
  if (all.is_even() && !(own.is_even() && own.usual > *all.gap)) return missing;
  double lost = 0.0;
  for (const double step : own.steps)
    if (step > *own.gap) lost += std::round(step / own.usual) - 1.0;
  return lost / (lost + static_cast<double>(own.steps.size()));
}

std::string missing_note(const Dataset& data, Index state, double missing) {
  const std::string& name = data.states[static_cast<std::size_t>(state)].name;
  const double lost = lacking(data, state, missing);
  if (lost > 0.0)
    return "dropouts: " + percent(lost) + " of the samples of " + name +
           " are blank, repeat the last value or lie on lines between others; they are left "
           "out";
  return name + " has samples of its own in " + percent(1.0 - missing) +
         " of the rows; the others (blank, the last value again or on lines between samples) "
         "are left out";
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
    if (channel.missing > 0.0)
      notes.push_back(missing_note(records.data, static_cast<Index>(k), channel.missing));
    const double span = span_of(records.data, static_cast<Index>(k));
    if (std::string note = quantised_note(state, channel, span); !note.empty())
      notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace lacuna
