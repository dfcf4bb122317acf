// SPDX-License-Identifier: MIT
#include "unit_hints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "core/base/text.hpp"
#include "data/units/in_units.hpp"
#include "slip_search.hpp"
#include "slips.hpp"

namespace lacuna {
namespace {

/// Mean over the equations that a correction changes of log(e_after / e_before); 0 where it
/// changes none.
double log_remainder_of(const Vector& before, const Vector& after) {
  constexpr double kUntouched = 1e-9;  // relative difference of a misfit that was not touched
  double sum = 0.0;
  int touched = 0;
  for (Index k = 0; k < before.size(); ++k) {
    if (std::abs(after[k] - before[k]) <= kUntouched * before[k]) continue;
    sum += 0.5 * std::log(after[k] / before[k]);
    ++touched;
  }
  return touched > 0 ? sum / touched : 0.0;
}

/// A factor and how much it leaves of the misfit.
struct SuggestedFactor {
  double factor = 1.0;
  double remainder = 1.0;  ///< of the misfit without it
};

/// The factor of a channel with the least misfit, on a grid of its logarithm that is made finer
/// around the best one.
SuggestedFactor suggested_factor(const OdeModel& model, const Dataset& data,
                                 const RateWindows& windows, Index channel) {
  // Units of one thing differ by less than a million; a step is a factor of 1.6, a well of the
  // misfit is wider.
  constexpr double kWidest = 14.0, kStep = 0.5, kFinest = 1e-4;
  const auto misfit_of = [&](const Dataset& tried) {
    return misfit(window_rates(tried, windows), model_rates(model, tried, windows));
  };
  const Vector before = misfit_of(data);
  const auto at = [&](double log_factor) {
    const Slip slip{HintKind::ChannelUnit, {channel}, std::exp(log_factor)};
    return log_remainder_of(before, misfit_of(corrected(model, data, slip)));
  };
  double best = 0.0, least = 0.0;
  const auto look_around = [&](double centre, double width, double step) {
    for (double x = centre - width; x <= centre + width; x += step)
      if (const double found = at(x); found < least) {
        least = found;
        best = x;
      }
  };
  look_around(0.0, kWidest, kStep);
  for (double step = kStep / 4.0; step > kFinest; step /= 4.0)
    look_around(best, 4.0 * step, step);
  return {std::exp(best), std::exp(least)};
}

/// A column in a unit that nothing converts to the one of the model.
struct OtherUnit {
  Quantity column;
  std::string wanted;
  Index channel = 0;  ///< number of a state, then (from m on) of an input
};

/// Columns of which each is in the unit of the other: "th [rpm], w [deg]" for rad and rad/s.
Hint hint_for_swapped(const OtherUnit& one, const OtherUnit& other) {
  const auto units_of = [](const OtherUnit& each) {
    return each.column.name + " is in " + each.column.unit + " and in " + each.wanted +
           " in the model";
  };
  return {HintKind::SwappedColumns,
          "columns " + one.column.name + " and " + other.column.name +
              " look swapped, each has a unit of the other: " + units_of(one) + ", " +
              units_of(other),
          "exchange the names of the columns " + one.column.name + " and " + other.column.name,
          Withheld::Answer};
}

/// The first two columns that fit in each other's place by their units.
std::optional<Hint> swapped_hint(const std::vector<OtherUnit>& all) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      if (!do_not_convert(all[i].column.unit, all[j].wanted) &&
          !do_not_convert(all[j].column.unit, all[i].wanted))
        return hint_for_swapped(all[i], all[j]);
  return std::nullopt;
}

/// The columns of records that are in such units.
std::vector<OtherUnit> in_other_units(const OdeModel& model, const Dataset& data) {
  std::vector<OtherUnit> all;
  const auto look = [&](const std::vector<Quantity>& columns,
                        const std::vector<Quantity>& wanted, Index first) {
    for (std::size_t i = 0; i < wanted.size() && i < columns.size(); ++i)
      if (do_not_convert(columns[i].unit, wanted[i].unit))
        all.push_back({columns[i], wanted[i].unit, first + static_cast<Index>(i)});
  };
  look(data.states, model.states(), 0);
  look(data.inputs, model.inputs(), model.dimension());
  return all;
}

/// How a turn is written in a unit of angle; nothing in another unit.
struct Turn {
  std::string text;
  double size = 0.0;
};

std::optional<Turn> turn_in(const std::string& unit) {
  if (unit == "rad") return Turn{"2*pi", 2.0 * std::numbers::pi};
  if (unit == "deg") return Turn{"360", 360.0};
  return std::nullopt;
}

/// Whether a measured state is whole numbers, so many that they may be counts of an encoder.
bool are_counts(const Dataset& data, Index k) {
  constexpr double kMany = 1000.0;  // a fact of encoders: next to none has less a turn
  if (!data.is_measured(k)) return false;
  double low = 0.0, high = 0.0;
  for (const Trajectory& record : data.trajectories) {
    const auto values = record.states.col(k).array();
    if (!(values == values.round()).all()) return false;
    low = std::min(low, values.minCoeff());
    high = std::max(high, values.maxCoeff());
  }
  return high - low >= kMany;
}

/// The factor is known to some per cent: what is certain is that these are counts.
Hint hint_for_counts(const Quantity& state, const Turn& turn, double factor) {
  const double counts = turn.size / factor;
  const double unit = std::pow(10.0, std::floor(std::log10(counts)) - 1.0);  // two digits
  return {
      HintKind::ChannelUnit,
      state.name + " is whole numbers in the records and in " + state.unit +
          " in the model, as counts of an encoder are, of which the records suggest about " +
          std::to_string(std::llround(std::round(counts / unit) * unit)) + " a turn",
      "give the column in " + state.unit + ": multiply " + state.name + " by " + turn.text +
          "/N, N the counts of a turn",
      Withheld::Answer};
}

/// States that are angles in the model and look like counts in the records, where a factor
/// undoes the misfit.
std::vector<Hint> count_hints(const OdeModel& model, const Dataset& data,
                              const RateWindows& windows, const HintOptions& options) {
  std::vector<Hint> hints;
  for (Index k = 0; k < model.dimension(); ++k) {
    const Quantity& state = model.states()[static_cast<std::size_t>(k)];
    const std::optional<Turn> turn = turn_in(state.unit);
    if (!turn || !are_counts(data, k)) continue;
    const SuggestedFactor found = suggested_factor(model, data, windows, k);
    if (found.remainder < options.slip_remainder && found.factor < 1.0)
      hints.push_back(hint_for_counts(state, *turn, found.factor));
  }
  return hints;
}

Hint hint_for_factor(const OtherUnit& one, double factor) {
  constexpr int kDigits = 4;  // more than a factor is known to
  const Quantity& column = one.column;
  return {HintKind::ChannelUnit,
          column.name + " is in " + column.unit + " in the records and in " + one.wanted +
              " in the model, and nothing converts these; the records suggest that 1 " +
              column.unit + " is " + format_number(factor, kDigits) + " " + one.wanted,
          "give the column in " + one.wanted + ", or the model the unit " + column.unit,
          Withheld::Answer};
}

/// "th (V for rad), w (V for rad/s)": an oscilloscope gives volts of every channel.
Hint hint_without_factor(const std::vector<OtherUnit>& all) {
  std::vector<std::string> columns;
  for (const OtherUnit& one : all)
    columns.push_back(one.column.name + " (" + one.column.unit + " for " + one.wanted + ")");
  return {HintKind::ChannelUnit,
          "nothing converts the units of the records to those of the model: " +
              join(columns, ", ") + "; values are taken as they are, and show no factor",
          "where a factor belongs between them, give the columns in the units of the model",
          Withheld::Nothing};
}

}  // namespace

std::vector<Hint> unit_hints(const OdeModel& model, const BoundRecords& records,
                             const RateWindows& windows, const HintOptions& options) {
  const std::vector<OtherUnit> all = in_other_units(model, records.data);
  if (auto swapped = swapped_hint(all)) return {*std::move(swapped)};
  std::vector<Hint> hints = count_hints(model, records.data, windows, options);
  std::vector<OtherUnit> without_factor;
  for (const OtherUnit& one : all) {
    const SuggestedFactor found = suggested_factor(model, records.data, windows, one.channel);
    if (found.remainder < options.slip_remainder)
      hints.push_back(hint_for_factor(one, found.factor));
    else
      without_factor.push_back(one);
  }
  if (!without_factor.empty()) hints.push_back(hint_without_factor(without_factor));
  return hints;
}

}  // namespace lacuna
