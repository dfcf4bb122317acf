// SPDX-License-Identifier: MIT
#include "readable.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "core/statistics/determined.hpp"
#include "data/records/piece_name.hpp"
#include "lacuna/core/statistics/interval.hpp"

namespace lacuna {
namespace {

/// Half of the 95 % interval of a coefficient, where it is known.
std::optional<double> error_of(const WeightedTerm& summand) {
  if (summand.ci95) return ((*summand.ci95)[1] - (*summand.ci95)[0]) / 2.0;
  if (summand.standard_error) return kNormalQuantile975 * *summand.standard_error;
  return std::nullopt;
}

/// "s" and the power 2 of "m/s^2"; nothing where the unit does not end in a power of time.
std::optional<int> power_of_time(const std::string& unit, const std::string& time) {
  const std::string end = "/" + time;
  const std::size_t at = unit.rfind(end);
  if (at == std::string::npos) return std::nullopt;
  const std::string rest = unit.substr(at + end.size());
  if (rest.empty()) return 1;
  if (rest.size() == 2 && rest[0] == '^' && rest[1] > '0' && rest[1] < '9')
    return rest[1] - '0';
  return std::nullopt;
}

}  // namespace

int digits_of(double value, double error) {
  if (!(error > 0.0) || value == 0.0) return 4;
  const double digits = std::ceil(std::log10(std::abs(value) / error)) + 1.0;
  return static_cast<int>(std::min(std::max(2.0, digits), 8.0));
}

std::string with_error(double value, double error) {
  if (error == 0.0) return format_number(value, 4);
  const std::string number = format_number(value, digits_of(value, error));
  if (!is_determined(value, error)) return number + " (not determined)";
  return number + " +- " + format_number(error, 2);
}

std::string coefficient_text(const WeightedTerm& summand, bool full) {
  if (full) return format_number(summand.coefficient);
  const auto error = error_of(summand);
  const bool known = error && *error > 0.0;
  return format_number(summand.coefficient, known ? digits_of(summand.coefficient, *error) : 6);
}

std::string percent(double fraction) {
  return format_number(100.0 * fraction, std::abs(fraction) < 0.995 ? 2 : 3) + " %";
}

std::string rate_unit(const std::string& unit, const std::string& time_unit) {
  if (unit.empty()) return "1/" + time_unit;
  const auto power = power_of_time(unit, time_unit);
  if (!power) return unit + "/" + time_unit;
  const std::string base = unit.substr(0, unit.rfind("/" + time_unit));
  return base + "/" + time_unit + "^" + std::to_string(*power + 1);
}

std::string target_unit(const OdeModel& model, Index equation) {
  const std::string& unit = model.states()[static_cast<std::size_t>(equation)].unit;
  return model.is_map() ? unit : rate_unit(unit, model.time_unit());
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

std::string short_name(const std::string& source) {
  const std::size_t comma = end_of_file_name(source);
  const std::size_t slash = source.rfind('/', comma);
  return slash == std::string::npos ? source : source.substr(slash + 1);
}

std::string equations_text(const OdeModel& model, bool full) {
  std::string text;
  for (std::size_t k = 0; k < model.states().size(); ++k) {
    text += left_hand_side(model.states()[k].name, model.evolution()) + " =";
    bool first = true;
    for (const WeightedTerm& summand : model.equations()[k]) {
      std::string number = coefficient_text(summand, full);
      const bool negative = number.front() == '-';
      if (negative) number.erase(0, 1);
      const std::string& term = summand.term.name();
      const bool plain = summand.term.expression().operation() != Operation::Add &&
                         summand.term.expression().operation() != Operation::Subtract &&
                         summand.term.expression().operation() != Operation::Negate;
      const std::string factor = plain ? term : "(" + term + ")";
      text += first ? (negative ? " -" : " ") : negative ? " - " : " + ";
      text += term == "1" ? number : number == "1" ? factor : number + "*" + factor;
      first = false;
    }
    text += first ? " 0\n" : "\n";
  }
  return text;
}

}  // namespace lacuna
