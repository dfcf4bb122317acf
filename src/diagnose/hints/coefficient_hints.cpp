// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/text.hpp"
#include "diagnose/hints/hints.hpp"
#include "slip_hints.hpp"

namespace lacuna {
namespace {

bool is_change_of(const OdeModel& model, const CoefficientFactor& change,
                  const EstimatedCoefficient& said) {
  return change.equation == said.equation &&
         model.equations()[static_cast<std::size_t>(change.equation)]
                          [static_cast<std::size_t>(change.summand)]
                              .term.name() == said.term;
}

/// Whether the records determine this factor, and no other near it.
bool is_said(const EstimatedCoefficient& said, double factor, double round_factor) {
  if (!(said.ratio * factor > 0.0)) return false;
  const double size = std::abs(factor) == 1.0 ? std::numbers::ln10 : std::log(std::abs(factor));
  const double tolerance = round_factor * std::abs(size);
  return std::abs(std::log(said.ratio / factor)) <= tolerance &&
         said.deviation <= tolerance * std::abs(said.ratio);
}

/// The power of a unit of time in each state: -1 of one that was made from another by its rate.
std::vector<double> powers_of_time(const OdeModel& model, const Dataset& data) {
  std::vector<double> powers(model.states().size(), 0.0);
  for (Index pass = 0; pass < model.dimension(); ++pass)  // a chain may run against their order
    for (Index k = 0; k < model.dimension(); ++k) {
      const auto rate = identity_of(model, k);
      if (rate && !data.is_measured(*rate))
        powers[static_cast<std::size_t>(*rate)] = powers[static_cast<std::size_t>(k)] - 1.0;
    }
  return powers;
}

/// The power of a factor of time in the ratio of a coefficient; nothing where it has none that
/// is known.
std::optional<double> power_of_time(const OdeModel& model, const std::vector<double>& powers,
                                    Index equation, const Term& term) {
  const std::set<std::string> used = term.expression().variables();
  if (used.contains("t")) return std::nullopt;
  double power = 1.0 - powers[static_cast<std::size_t>(equation)];
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (powers[i] == 0.0 || !used.contains(model.states()[i].name)) continue;
    const auto& exponents = term.exponents();
    if (!exponents) return std::nullopt;
    power += powers[i] * (*exponents)[i];
  }
  return power;
}

/// "all rates are 12.5 times too small", with what that says of the clock.
Hint clock_message(double factor, double step, const std::string& time_unit) {
  const auto in_time = [&](double value) { return format_number(value, 3) + " " + time_unit; };
  const std::string size = factor < 1.0 ? format_number(1.0 / factor, 3) + " times too small"
                                        : format_number(factor, 3) + " times too large";
  return {HintKind::TimeUnit,
          "all rates are " + size + " for the model: look at the clock (a step of " +
              in_time(step * factor) + " where the records have " + in_time(step) +
              "?), or at what divides them all, as a mass or a capacity does",
          "multiply the time column by " + format_number(factor, 4) + " if the clock is wrong"};
}

}  // namespace

std::optional<Hint> clock_hint(const OdeModel& model, const Dataset& data,
                               const std::vector<EstimatedCoefficient>& said,
                               const HintOptions& options) {
  const std::vector<double> powers = powers_of_time(model, data);
  struct Ratio {
    double log, power, error;
  };
  std::vector<Ratio> ratios;
  for (Index k = 0; k < model.dimension(); ++k) {
    const auto rate = identity_of(model, k);
    if (rate && !data.is_measured(*rate)) continue;  // holds by itself
    for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(k)]) {
      const auto one = std::find_if(said.begin(), said.end(), [&](const auto& each) {
        return each.equation == k && each.term == summand.term.name();
      });
      const auto power = power_of_time(model, powers, k, summand.term);
      if (one == said.end() || !(one->ratio > 0.0) || !power) return std::nullopt;
      ratios.push_back({std::log(one->ratio), *power, one->deviation / one->ratio});
    }
  }
  double product = 0.0, square = 0.0;
  for (const Ratio& one : ratios) {
    product += one.power * one.log;
    square += one.power * one.power;
  }
  if (ratios.size() < 2 || !(square > 0.0)) return std::nullopt;
  const double log_factor = product / square;
  const double tolerance = options.round_factor * std::abs(log_factor);
  const bool is_common = std::all_of(ratios.begin(), ratios.end(), [&](const Ratio& one) {
    return std::abs(one.log - one.power * log_factor) <= tolerance && one.error <= tolerance;
  });
  if (!is_common || std::abs(log_factor) < std::log(options.identity_factor))
    return std::nullopt;
  return clock_message(std::exp(log_factor), median_step(data), model.time_unit());
}

std::optional<Hint> coefficient_hint(const OdeModel& model, const Dataset& data,
                                     const EstimatedCoefficient& said,
                                     const HintOptions& options) {
  for (const Slip& slip : possible_slips(model, data)) {
    const auto change = as_coefficient(model, slip);
    if (!change || !is_change_of(model, *change, said)) continue;
    if (!is_said(said, change->factor, options.round_factor)) continue;
    Hint hint = hint_of(model, {slip, Vector(), Vector()});
    hint.withheld = Withheld::Nothing;
    return hint;
  }
  return std::nullopt;
}

}  // namespace lacuna
