// SPDX-License-Identifier: MIT
#include "structure.hpp"

#include <cmath>

#include "core/base/text.hpp"

namespace lacuna::benchmarks {
namespace {

using Support = std::set<Powers>;

const Support kOne{Powers{}};

Support product(const Support& a, const Support& b) {
  Support all;
  for (const Powers& left : a)
    for (const Powers& right : b) {
      Powers both = left;
      for (const auto& [factor, exponent] : right)
        if ((both[factor] += exponent) == 0) both.erase(factor);
      all.insert(std::move(both));
    }
  return all;
}

Fraction product(const Fraction& a, const Fraction& b) {
  return {product(a.numerator, b.numerator), product(a.denominator, b.denominator)};
}

Fraction sum(const Fraction& a, const Fraction& b) {
  const bool same = a.denominator == b.denominator;
  Fraction result{same ? a.numerator : product(a.numerator, b.denominator),
                  same ? a.denominator : product(a.denominator, b.denominator)};
  result.numerator.merge(same ? Support(b.numerator) : product(b.numerator, a.denominator));
  return result;
}

Fraction inverse(const Fraction& fraction) {
  return {fraction.denominator, fraction.numerator};
}

Fraction factor(const std::string& name) { return {{Powers{{name, 1}}}, kOne}; }

bool is_whole(const Expression& number) { return number.value() == std::round(number.value()); }

Fraction fraction_of(const Expression& expression);

Fraction power(const Expression& base, const Expression& exponent) {
  if (base.operation() == Operation::Number) return {kOne, kOne};
  if (exponent.operation() != Operation::Number || !is_whole(exponent))
    return factor((base.to_string() + "^") + exponent.to_string());
  Fraction result{kOne, kOne};
  const Fraction once = fraction_of(base);
  for (int i = 0; i < static_cast<int>(std::abs(exponent.value())); ++i)
    result = product(result, once);
  return exponent.value() < 0.0 ? inverse(result) : result;
}

Fraction fraction_of(const Expression& expression) {
  const auto operands = expression.operands();
  switch (expression.operation()) {
    case Operation::Number:
      return {kOne, kOne};
    case Operation::Negate:
      return fraction_of(operands[0]);
    case Operation::Add:
    case Operation::Subtract:
      return sum(fraction_of(operands[0]), fraction_of(operands[1]));
    case Operation::Multiply:
      return product(fraction_of(operands[0]), fraction_of(operands[1]));
    case Operation::Divide:
      return product(fraction_of(operands[0]), inverse(fraction_of(operands[1])));
    case Operation::Power:
      return power(operands[0], operands[1]);
    case Operation::Exp: {
      std::string name = "exp";
      for (const std::string& variable : expression.variables()) name += " " + variable;
      return factor(name);
    }
    default:
      return factor(expression.to_string());
  }
}

/// Numbers in an expression that are no whole ones.
std::size_t numbers_in(const Expression& expression) {
  if (expression.operation() == Operation::Number) return is_whole(expression) ? 0 : 1;
  std::size_t count = 0;
  for (const Expression& operand : expression.operands()) count += numbers_in(operand);
  return count;
}

}  // namespace

Fraction fraction_of(const Equation& equation) {
  Fraction all{{}, kOne};
  for (const WeightedTerm& summand : equation) {
    const Fraction one = fraction_of(summand.term.expression());
    all = all.numerator.empty() ? one : sum(all, one);
  }
  return all;
}

std::size_t numbers_in(const Equation& equation) {
  std::size_t count = equation.size();
  for (const WeightedTerm& summand : equation) count += numbers_in(summand.term.expression());
  return count;
}

}  // namespace lacuna::benchmarks
