// SPDX-License-Identifier: MIT
#include "lacuna/records/hints.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "coefficient_pattern.hpp"
#include "motion_hints.hpp"
#include "slip_hints.hpp"
#include "unused_columns.hpp"

namespace lacuna {
namespace {

constexpr Index kFewestWindows = 20;  // what less of them show may be chance

void append(std::vector<Hint>& hints, std::vector<Hint> more) {
  std::move(more.begin(), more.end(), std::back_inserter(hints));
}

/// What keeps the names of effects from being said.
std::vector<Hint> other_causes(const OdeModel& model, const BoundRecords& records,
                               const Dataset& unused, const RateWindows& windows,
                               const HintOptions& options) {
  auto slip = find_slip(model, records.data, windows, options);
  if (!slip) slip = slip_of_coefficients(model, records.data, windows, options);
  if (slip) return {hint_of(model, *slip)};
  std::vector<Hint> hints = identity_hints(model, records.data, windows, options);
  if (hints.empty() && unused.input_count() > 0)
    append(hints, unused_column_hints(model, records, unused, windows, options));
  return hints;
}

}  // namespace

std::string to_string(HintKind kind) {
  switch (kind) {
    case HintKind::TimeUnit:
      return "time-unit";
    case HintKind::ChannelUnit:
      return "channel-unit";
    case HintKind::Sign:
      return "sign";
    case HintKind::SwappedColumns:
      return "swapped-columns";
    case HintKind::UnusedColumn:
      return "unused-column";
    case HintKind::Identity:
      return "identity";
    case HintKind::ClosedLoop:
      return "closed-loop";
    case HintKind::Excitation:
      return "excitation";
    case HintKind::Sampling:
      return "sampling";
    case HintKind::NotIdentifiable:
      return "not-identifiable";
  }
  return "";
}

void HintOptions::describe(OptionVisitor& v) {
  v.field(
      {"slip_remainder", "",
       "A slip of units, signs or columns is one where, undone, it leaves no more than this "
       "share of the misfit (geometric mean over the equations it changes).",
       0.0, 1.0},
      slip_remainder);
  v.field({"slip_misfit", "",
           "Equations in which model and records are apart by less than this share of their "
           "rates have no slip.",
           0.0, 1.0},
          slip_misfit);
  v.field(
      {"round_factor", "",
       "A factor is that of a unit where the records say it to this share of its logarithm.",
       0.0, 1.0},
      round_factor);
  v.field({"identity_factor", "",
           "An identity dq/dt = v that is off by a larger factor, or by sign, is a slip; less "
           "is a gain of a sensor.",
           1.0},
          identity_factor);
  v.field({"column_share", "",
           "A column that the model does not know is an input where it explains a larger share "
           "of what an equation lacks.",
           0.0, 1.0},
          column_share);
  v.field({"column_sigma", "standard deviations",
           "What such a column explains is chance where it is less significant.", 0.0},
          column_sigma);
  v.field(
      {"feedback", "",
       "An input of which the states make up a larger share is in a closed loop.", 0.0, 1.0},
      feedback);
  v.field({"samples_per_period", "samples",
           "Less in a mean period of the fastest state is few.", 2.0},
          samples_per_period);
  v.field({"barely_moving", "standard deviations",
           "A state that deviates from its mean by fewer of its noise hardly moves.", 0.0},
          barely_moving);
}

std::vector<Hint> look_at(const OdeModel& model, const BoundRecords& records,
                          const Dataset& unused, const HintOptions& options) {
  // A delayed value needs the record before a window; such models are taken as they are.
  if (!model.compile().delays().empty()) return {};
  const RateWindows windows = rate_windows(records);
  if (windows.count() < kFewestWindows) return {};
  std::vector<Hint> hints = other_causes(model, records, unused, windows, options);
  if (withheld_by(hints) != Withheld::Answer)
    append(hints, motion_hints(model, records, windows, options));
  return hints;
}

Withheld withheld_by(const std::vector<Hint>& hints) {
  Withheld most = Withheld::Nothing;
  for (const Hint& hint : hints) most = std::max(most, hint.withheld);
  return most;
}

}  // namespace lacuna
