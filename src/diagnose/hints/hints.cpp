// SPDX-License-Identifier: MIT
#include "diagnose/hints/hints.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "coefficient_pattern.hpp"
#include "motion_hints.hpp"
#include "slip_hints.hpp"
#include "unit_hints.hpp"
#include "unused_columns.hpp"

namespace lacuna {
namespace {

void append(std::vector<Hint>& hints, std::vector<Hint> more) {
  std::move(more.begin(), more.end(), std::back_inserter(hints));
}

/// What keeps the names of effects from being said.
std::vector<Hint> other_causes(const OdeModel& model, const BoundRecords& records,
                               const Dataset& unused, const RateWindows& windows,
                               const HintOptions& options) {
  std::vector<Hint> units = unit_hints(model, records, windows, options);
  if (withheld_by(units) == Withheld::Answer) return units;
  auto slip = find_slip(model, records.data, windows, options);
  if (!slip) slip = slip_of_coefficients(model, records.data, windows, options);
  if (slip) {
    units.push_back(hint_of(model, *slip));
    return units;
  }
  std::vector<Hint> hints = identity_hints(model, records.data, windows, options);
  append(hints, std::move(units));
  if (withheld_by(hints) == Withheld::Nothing && unused.input_count() > 0)
    append(hints, unused_column_hints(model, records, unused, windows, options));
  return hints;
}

}  // namespace

namespace {

/// Slips of units, signs and identities.
void describe_slips(HintOptions& o, OptionVisitor& v) {
  v.field({"slip_remainder", "",
           "A slip of units, signs or columns is one where, undone, it leaves no more than "
           "this fraction of the misfit (geometric mean over the equations it changes).",
           0.0, 1.0},
          o.slip_remainder);
  v.field({"slip_misfit", "",
           "Equations in which model and records are apart by less than this fraction of their "
           "rates have no slip.",
           0.0, 1.0},
          o.slip_misfit);
  v.field({"slip_alike", "",
           "Slips that leave misfits (or changes of coefficients) within this ratio are not "
           "distinguished: the plainest is named.",
           1.0},
          o.slip_alike);
  v.field({"slip_harm", "",
           "An equation may gain this much misfit (rms, as a fraction of its rates) by undoing "
           "a slip.",
           0.0, 1.0},
          o.slip_harm);
  v.field({"slip_factor", "",
           "Two coefficients that are off by a larger factor each are so by a unit: effects "
           "that are missing bend them less.",
           1.0},
          o.slip_factor);
  v.field({"round_factor", "",
           "A factor is that of a unit where the records determine it to this fraction of its "
           "logarithm.",
           0.0, 1.0},
          o.round_factor);
  v.field({"identity_factor", "",
           "An identity dq/dt = v that is off by a larger factor, or by sign, is a slip; less "
           "is a gain of a sensor.",
           1.0},
          o.identity_factor);
  v.field({"identity_match", "",
           "The factor of an identity means something where the two sides correlate by more.",
           0.0, 1.0},
          o.identity_match);
}

/// Columns that the model does not know.
void describe_columns(HintOptions& o, OptionVisitor& v) {
  v.field({"column_share", "",
           "A column that the model does not know is an input where it explains a larger "
           "fraction of what an equation lacks.",
           0.0, 1.0},
          o.column_fraction);
  v.field({"column_own", "",
           "Such a column has something of its own where the terms of the model make up all "
           "but this fraction of it.",
           0.0, 1.0},
          o.column_own);
  v.field(
      {"column_rate", "",
       "A column that is apart from the rate of a state by a smaller fraction is that rate.",
       0.0, 1.0},
      o.column_rate);
  v.field({"told", "standard deviations",
           "What such a column explains, what the records show of a coefficient, or how far "
           "samples are from white noise is chance where it is less significant.",
           0.0},
          o.significance);
}

/// What the records cannot say.
void describe_motion(HintOptions& o, OptionVisitor& v) {
  v.field(
      {"feedback", "",
       "An input of which the states make up a larger fraction is in a closed loop.", 0.0, 1.0},
      o.feedback);
  v.field({"samples_per_period", "samples",
           "Less in a mean period of the fastest state is few.", 2.0},
          o.samples_per_period);
  v.field(
      {"periods", "mean periods", "A record with fewer says little of what comes back.", 0.0},
      o.periods);
  v.field({"barely_moving", "standard deviations",
           "A state that deviates from its mean by fewer of its noise hardly moves.", 0.0},
          o.barely_moving);
  v.field({"alike_terms", "",
           "Terms of which a combination is a smaller fraction of them have coefficients that "
           "the records do not distinguish.",
           0.0, 1.0},
          o.alike_terms);
}

}  // namespace

void HintOptions::describe(OptionVisitor& v) {
  describe_slips(*this, v);
  describe_columns(*this, v);
  describe_motion(*this, v);
}

std::vector<Hint> look_at(const OdeModel& model, const BoundRecords& records,
                          const Dataset& unused, const HintOptions& options) {
  // A delayed value needs the record before a window; such models are taken as they are.
  const bool delayed = !model.compile().delays().empty();
  const RateWindows windows = delayed ? RateWindows{} : rate_windows(records);
  if (delayed || windows.count() < kFewestWindows) {
    if (auto still = stillness(records, options)) return {std::move(*still)};
    return {};
  }
  std::vector<Hint> hints = other_causes(model, records, unused, windows, options);
  if (withheld_by(hints) != Withheld::Answer)
    append(hints, motion_hints(model, records, windows, options));
  return hints;
}

}  // namespace lacuna
