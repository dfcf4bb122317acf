// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"

namespace lacuna {
namespace {

constexpr int kAllDigits = 17;  // of a double

/// Digits of numbers inside terms. At half as many a frequency is a turn off after 10^4 periods;
/// at twice as many they are all that a double has.
constexpr int kDigitsInside = 8;

double rounded_to(double value, int digits) {
  return parse_number(format_number(value, digits)).value_or(value);
}

double rounded_by(double value, std::optional<double> half, const Digits& digits) {
  if (digits.significant) return rounded_to(value, *digits.significant);
  return half && *half > 0.0 ? rounded_to(value, digits_of(value, *half)) : value;
}

/// Terms that differ in later digits only stay as they are: no term stands twice.
Equation rounded_equation(const Equation& equation, const Variables& variables,
                          const Digits& digits) {
  Equation result;
  std::set<std::string> names;
  for (const WeightedTerm& summand : equation) names.insert(summand.term.name());
  for (WeightedTerm summand : equation) {
    if (!summand.fixed)
      summand.coefficient = rounded_by(summand.coefficient, half_interval(summand), digits);
    Term term(with_rounded_numbers(summand.term.expression(), kDigitsInside), variables);
    if (names.insert(term.name()).second) summand.term = std::move(term);
    result.push_back(std::move(summand));
  }
  return result;
}

Parameter rounded_parameter(Parameter parameter, const Digits& digits) {
  if (!parameter.free) return parameter;
  std::optional<double> half;
  if (parameter.ci95)
    half = ((*parameter.ci95)[1] - (*parameter.ci95)[0]) / 2.0;
  else if (parameter.standard_error)
    half = kNormalQuantile975 * *parameter.standard_error;
  const double exact = parameter.value;
  parameter.value = rounded_by(exact, half, digits);
  if (!range_problem(parameter).empty()) parameter.value = exact;
  return parameter;
}

}  // namespace

namespace {

/// A sum or difference as people write it: "-y" for 0-y and -0-y, "x+2" for x-(-2).
Expression plain_sum(bool adds, const Expression& a, const Expression& b) {
  if (is_number(b) && b.value() < 0.0)
    return plain_sum(!adds, a, Expression::number(-b.value()));
  if (is_number(b, 0.0)) return a;
  if (is_number(a, 0.0)) return adds ? b : Expression::make(Operation::Negate, {b});
  return Expression::make(adds ? Operation::Add : Operation::Subtract, {a, b});
}

Expression plainly_made(Operation operation, std::vector<Expression> operands) {
  const bool adds = operation == Operation::Add;
  if (adds || operation == Operation::Subtract)
    return plain_sum(adds, operands[0], operands[1]);
  if (operation == Operation::Negate && is_number(operands[0]))
    return Expression::number(operands[0].value() == 0.0 ? 0.0 : -operands[0].value());
  return Expression::make(operation, std::move(operands));
}

}  // namespace

Expression with_rounded_numbers(const Expression& e, int digits) {
  if (is_number(e))  // 0 has no sign
    return Expression::number(is_number(e, 0.0) ? 0.0 : rounded_to(e.value(), digits));
  if (e.operation() == Operation::Variable) return e;
  if (e.operation() == Operation::Delay)
    return e.operands().empty()
               ? Expression::delayed(e.name(), rounded_to(e.value(), digits))
               : Expression::delayed(e.name(), with_rounded_numbers(e.operands()[0], digits));
  std::vector<Expression> operands;
  for (const Expression& operand : e.operands())
    operands.push_back(with_rounded_numbers(operand, digits));
  return plainly_made(e.operation(), std::move(operands));
}

Digits parse_digits(std::string_view text) {
  if (text == "auto") return {};
  if (text == "full") return {.full = true};
  const auto number = parse_number(text);
  if (!number || *number != std::floor(*number) || *number < 1.0 || *number > kAllDigits)
    throw ConfigError("--digits " + std::string(text), "this is no number of digits",
                      "give auto, full or a number from 1 to 17");
  return {.significant = static_cast<int>(*number)};
}

int digits_of(double value, double error) {
  constexpr int kWithoutError = 4, kLeast = 2;
  if (!(error > 0.0) || !std::isfinite(error) || value == 0.0) return kWithoutError;
  const double digits =
      std::floor(std::log10(std::abs(value))) - std::floor(std::log10(error)) + 2.0;
  return static_cast<int>(std::clamp<double>(digits, kLeast, kAllDigits));
}

std::optional<double> half_interval(const WeightedTerm& summand) {
  std::optional<double> half;
  if (summand.ci95)
    half = ((*summand.ci95)[1] - (*summand.ci95)[0]) / 2.0;
  else if (summand.standard_error)
    half = kNormalQuantile975 * *summand.standard_error;
  return half && *half > 0.0 ? half : std::nullopt;
}

SystemModel rounded(const SystemModel& model, const Digits& digits) {
  if (digits.full) return model;
  std::vector<Equation> equations;
  for (const Equation& equation : model.symbolic().equations())
    equations.push_back(rounded_equation(equation, model.symbolic().variables(), digits));
  std::vector<Parameter> parameters;
  for (const Parameter& parameter : model.parameters())
    parameters.push_back(rounded_parameter(parameter, digits));
  return {model.symbolic().with_equations(std::move(equations)), std::move(parameters)};
}

}  // namespace lacuna
