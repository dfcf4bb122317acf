// SPDX-License-Identifier: MIT
#include "readable.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/text.hpp"
#include "core/statistics/determined.hpp"
#include "data/records/piece_name.hpp"

namespace lacuna {
namespace {

/// Most digits of a number in a sentence; records seldom determine more.
constexpr int kMostShown = 8;

constexpr std::string_view kUnknown = "not determined";

int shown_digits(double value, double error) {
  return std::min(kMostShown, digits_of(value, error));
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

/// Whether an interval lies behind the last digit that is shown.
bool is_sure_to_all_digits(const WeightedTerm& summand) {
  const auto half = half_interval(summand);
  return half && digits_of(summand.coefficient, *half) > kMostShown;
}

/// "2*x", "x" for a number 1, "(2.01 +- 0.03)*x", "2*(x + y)".
std::string product_text(std::string number, const std::string& half, const Term& term) {
  const Operation outermost = term.expression().operation();
  const bool is_sum = outermost == Operation::Add || outermost == Operation::Subtract ||
                      outermost == Operation::Negate;
  const std::string factor = is_sum ? "(" + term.name() + ")" : term.name();
  if (!half.empty()) number = "(" + number + (half == kUnknown ? ", " : " +- ") + half + ")";
  if (term.name() == "1") return number;
  return number == "1" ? factor : number + "*" + factor;
}

}  // namespace

std::string with_error(double value, double error) {
  if (error == 0.0) return format_number(value, 4);
  const std::string number = format_number(value, shown_digits(value, error));
  if (!is_determined(value, error)) return number + " (" + std::string(kUnknown) + ")";
  return number + " +- " + format_number(error, 2);
}

std::string coefficient_text(const WeightedTerm& summand, const Digits& digits) {
  constexpr int kWithoutInterval = 6;
  const double value = summand.coefficient;
  if (digits.full) return format_number(value);
  if (digits.significant) return format_number(value, *digits.significant);
  const auto half = half_interval(summand);
  return format_number(value, half ? shown_digits(value, *half) : kWithoutInterval);
}

std::string half_text(const WeightedTerm& summand) {
  const auto half = half_interval(summand);
  if (!half) return "";
  return is_determined(summand.coefficient, *half) ? format_number(*half, 2)
                                                   : std::string(kUnknown);
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

std::string equation_text(const OdeModel& model, Index equation, const Digits& digits,
                          Intervals intervals) {
  const auto k = static_cast<std::size_t>(equation);
  std::string text = left_hand_side(model.states()[k].name, model.evolution()) + " =";
  bool first = true;
  for (const WeightedTerm& summand : model.equations()[k]) {
    std::string number = coefficient_text(summand, digits);
    const bool negative = number.front() == '-';
    if (negative) number.erase(0, 1);
    text += first ? (negative ? " -" : " ") : negative ? " - " : " + ";
    const bool is_shown = intervals == Intervals::Shown && !is_sure_to_all_digits(summand);
    text += product_text(number, is_shown ? half_text(summand) : "", summand.term);
    first = false;
  }
  return text + (first ? " 0" : "");
}

std::string dead_time_sentence(const DeadTime& late, const std::string& time_unit) {
  const std::string time =
      late.ci95 ? with_error(late.time, 0.5 * ((*late.ci95)[1] - (*late.ci95)[0]))
                : format_number(late.time, 6);
  return late.input + " acts " + time + (time_unit.empty() ? "" : " " + time_unit) +
         " after it is recorded";
}

}  // namespace lacuna
