// SPDX-License-Identifier: MIT
#include "slip_hints.hpp"

#include <cmath>
#include <numbers>

#include "core/base/text.hpp"
#include "records/binding/time_unit.hpp"

namespace lacuna {
namespace {

bool is_near(double a, double b) { return std::abs(a / b - 1.0) < 1e-6; }

/// "1000 times too large" of what has to be multiplied by 0.001.
std::string size_of(double correction) {
  return correction < 1.0 ? format_number(1.0 / correction, 5) + " times too large"
                          : format_number(correction, 5) + " times too small";
}

/// What a factor between units of angle usually means.
std::string units_of(double correction) {
  const double turn = 2.0 * std::numbers::pi, degrees = 180.0 / std::numbers::pi;
  if (is_near(correction, 1.0 / degrees)) return ", as degrees are for radians";
  if (is_near(correction, degrees)) return ", as radians are for degrees";
  if (is_near(correction, turn)) return ", as turns (or Hz) are for radians (or rad/s)";
  if (is_near(correction, 1.0 / turn)) return ", as radians (or rad/s) are for turns (or Hz)";
  if (is_near(correction, turn / 60.0)) return ", as turns per minute are for rad/s";
  if (is_near(correction, 60.0 / turn)) return ", as rad/s are for turns per minute";
  return "";
}

std::string names_of(const OdeModel& model, const Slip& slip) {
  std::vector<std::string> names;
  for (const Index channel : slip.channels) names.push_back(channel_name(model, channel));
  return join(names, " and ");
}

std::string time_message(const OdeModel& model, const Slip& slip) {
  std::string text = "time looks " + size_of(slip.correction) + " for the model";
  const auto unit = scaled_time_unit(model.time_unit(), slip.correction);
  if (unit) text += ", as if its unit were " + *unit + " and not " + model.time_unit();
  return text;
}

std::string message_of(const OdeModel& model, const Slip& slip) {
  const bool many = slip.channels.size() > 1;
  const std::string names = names_of(model, slip);
  switch (slip.kind) {
    case HintKind::TimeUnit:
      return time_message(model, slip);
    case HintKind::Sign:
      return "the sign of " + names + " looks reversed";
    case HintKind::SwappedColumns:
      return "columns " + names + " look swapped, each is in the place of the other";
    default:
      return names + (many ? " look " : " looks ") + size_of(slip.correction) +
             " for the model, a unit that is another" + units_of(slip.correction);
  }
}

std::string remedy_of(const OdeModel& model, const Slip& slip) {
  const std::string names = names_of(model, slip);
  switch (slip.kind) {
    case HintKind::TimeUnit: {
      const auto unit = scaled_time_unit(model.time_unit(), slip.correction);
      if (unit) return "--time-unit " + *unit;
      return "multiply the time column by " + format_number(slip.correction, 6);
    }
    case HintKind::Sign:
      return "change the sign of " + names + " in the records or in the model";
    case HintKind::SwappedColumns:
      return "exchange the names of the columns " + names;
    default:
      return "multiply " + names + " by " + format_number(slip.correction, 6) +
             " or give the model the unit of the records";
  }
}

/// That it may as well be a coefficient of the model.
std::string coefficient_message(const OdeModel& model, const CoefficientFactor& change) {
  const WeightedTerm& summand = model.equations()[static_cast<std::size_t>(change.equation)]
                                                 [static_cast<std::size_t>(change.summand)];
  return "; the coefficient " + format_number(summand.coefficient, 6) + " of " +
         summand.term.name() + " in d" + channel_name(model, change.equation) +
         "/dt may be wrong as well, by the factor " + format_number(change.factor, 4);
}

}  // namespace

Hint hint_of(const OdeModel& model, const FoundSlip& found) {
  Hint hint{found.slip.kind, message_of(model, found.slip), remedy_of(model, found.slip),
            Withheld::Answer};
  for (const Slip& other : found.others) hint.message += "; or " + message_of(model, other);
  if (const auto change = as_coefficient(model, found.slip)) {
    hint.message += coefficient_message(model, *change);
    hint.withheld = Withheld::Names;
  }
  return hint;
}

std::vector<Hint> identity_hints(const OdeModel& model, const Dataset& data,
                                 const RateWindows& windows, const HintOptions& options) {
  const Matrix measured = window_rates(data, windows);
  const Matrix modelled = model_rates(model, data, windows);
  std::vector<Hint> hints;
  for (Index k = 0; k < model.dimension(); ++k) {
    const auto rate = identity_of(model, k);
    if (!rate || !data.is_measured(*rate) || !data.is_measured(k)) continue;
    const Vector y = measured.col(k).array() - measured.col(k).mean();
    const Vector v = modelled.col(k).array() - modelled.col(k).mean();
    const double correlation = y.dot(v) / (y.norm() * v.norm());
    if (!(std::abs(correlation) >= options.identity_match)) continue;
    const double factor = std::copysign(y.norm() / v.norm(), correlation);
    if (factor > 1.0 / options.identity_factor && factor < options.identity_factor) continue;
    const std::string &q = channel_name(model, k), &p = channel_name(model, *rate);
    hints.push_back({HintKind::Identity,
                     "the model says d" + q + "/dt = " + p + ", but in the records d" + q +
                         "/dt is " + format_number(factor, 4) + " times " + p +
                         ": the identity is off by this factor, a unit or sign of " + q + ", " +
                         p + " or the time",
                     "give " + q + ", " + p + " and the time units that fit together",
                     Withheld::Answer});
  }
  return hints;
}

}  // namespace lacuna
