// SPDX-License-Identifier: MIT
#include "model/expressions/total_degree.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// Beyond any basis; a decision that keeps x^1e9 an int.
constexpr double kMostPower = 1000.0;

int degree_of_power(const Expression& base, const Expression& exponent) {
  if (!is_number(exponent) || exponent.value() != std::round(exponent.value())) return 1;
  const double power = std::min(std::abs(exponent.value()), kMostPower);
  return static_cast<int>(std::min(power * total_degree(base), kMostPower));
}

}  // namespace

int total_degree(const Expression& expression) {
  const auto operands = expression.operands();
  switch (expression.operation()) {
    case Operation::Number:
      return 0;
    case Operation::Add:
    case Operation::Subtract:
      return std::max(total_degree(operands[0]), total_degree(operands[1]));
    case Operation::Multiply:
    case Operation::Divide:
      return total_degree(operands[0]) + total_degree(operands[1]);
    case Operation::Negate:
      return total_degree(operands[0]);
    case Operation::Power:
      return expression.variables().empty() ? 0 : degree_of_power(operands[0], operands[1]);
    default:
      return expression.variables().empty() ? 0 : 1;
  }
}

}  // namespace lacuna
