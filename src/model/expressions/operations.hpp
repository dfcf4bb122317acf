// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// Number of operands of an operation; 0 for leaves.
int arity(Operation operation) noexcept;

/// Name of an operation that is written as a function ("sin"), empty for the others.
std::string_view function_name(Operation operation) noexcept;

/// The operation of that function name, `delay` included.
std::optional<Operation> function_named(std::string_view name) noexcept;

/// Names of all functions.
std::vector<std::string> function_names();

/// The value of one operation; NaN outside its domain.
double apply_operation(Operation operation, const std::array<double, 3>& operands) noexcept;

/// The value of a formula without variables.
std::optional<double> constant_value(const Expression& expression);

/// Whether one of the names stands in a formula.
bool has_any(const Expression& expression, const std::set<std::string>& names);

/// What each operation means, in one place: calls `visitor.unary(f)`, `visitor.binary(f)` or
/// `visitor.ternary(f)` with the function on doubles. NaN operands give NaN everywhere.
template <class Visitor>
void with_function(Operation operation, Visitor&& visitor) {
  constexpr auto smaller = [](double a, double b) { return a < b || a != a ? a : b; };
  constexpr auto larger = [](double a, double b) { return a > b || a != a ? a : b; };
  switch (operation) {
    case Operation::Add:
      return visitor.binary([](double a, double b) { return a + b; });
    case Operation::Subtract:
      return visitor.binary([](double a, double b) { return a - b; });
    case Operation::Multiply:
      return visitor.binary([](double a, double b) { return a * b; });
    case Operation::Divide:
      return visitor.binary([](double a, double b) { return a / b; });
    case Operation::Power:
      return visitor.binary([](double a, double b) { return std::pow(a, b); });
    case Operation::Negate:
      return visitor.unary([](double a) { return -a; });
    case Operation::Sin:
      return visitor.unary([](double a) { return std::sin(a); });
    case Operation::Cos:
      return visitor.unary([](double a) { return std::cos(a); });
    case Operation::Tan:
      return visitor.unary([](double a) { return std::tan(a); });
    case Operation::Asin:
      return visitor.unary([](double a) { return std::asin(a); });
    case Operation::Acos:
      return visitor.unary([](double a) { return std::acos(a); });
    case Operation::Atan:
      return visitor.unary([](double a) { return std::atan(a); });
    case Operation::Tanh:
      return visitor.unary([](double a) { return std::tanh(a); });
    case Operation::Exp:
      return visitor.unary([](double a) { return std::exp(a); });
    case Operation::Log:
      return visitor.unary([](double a) { return std::log(a); });
    case Operation::Sqrt:
      return visitor.unary([](double a) { return std::sqrt(a); });
    case Operation::Abs:
      return visitor.unary([](double a) { return std::abs(a); });
    case Operation::Sign:
      return visitor.unary([](double a) { return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : a; });
    case Operation::Step:
      return visitor.unary([](double a) { return a >= 0.0 ? 1.0 : a < 0.0 ? 0.0 : a; });
    case Operation::Min:
      return visitor.binary(smaller);
    case Operation::Max:
      return visitor.binary(larger);
    case Operation::Clip:
      return visitor.ternary(
          [=](double x, double low, double high) { return smaller(larger(x, low), high); });
    case Operation::Number:
    case Operation::Variable:
    case Operation::Delay:
      return;
  }
}

}  // namespace lacuna
