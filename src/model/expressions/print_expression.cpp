// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include "core/base/text.hpp"
#include "lacuna/model/expressions/expression.hpp"
#include "operations.hpp"

namespace lacuna {
namespace {

/// How tightly the outermost operation of a text binds.
enum Binding { kSum, kProduct, kSign, kPower, kAtom };

struct Printed {
  std::string text;
  Binding binding;
};

Printed print(const Expression& expression);

std::string in_parentheses(const std::string& text) {
  std::string result(1, '(');
  result += text;
  result += ')';
  return result;
}

/// The operand, in parentheses when it binds less tightly than its place needs.
std::string operand_text(const Expression& operand, Binding needed) {
  Printed printed = print(operand);
  return printed.binding >= needed ? std::move(printed.text) : in_parentheses(printed.text);
}

/// A right-hand operand; one that begins with a sign stands in parentheses: "x-(-y*z)".
std::string right_text(const Expression& operand, Binding needed) {
  std::string text = operand_text(operand, needed);
  return text.front() == '-' ? in_parentheses(text) : text;
}

Printed print_sum(const Expression& e, char sign) {
  return {operand_text(e.operands()[0], kSum) + sign + right_text(e.operands()[1], kProduct),
          kSum};
}

Printed print_product(const Expression& e, char sign) {
  return {operand_text(e.operands()[0], kProduct) + sign + right_text(e.operands()[1], kSign),
          kProduct};
}

Printed print_power(const Expression& e) {
  return {operand_text(e.operands()[0], kAtom) + '^' + operand_text(e.operands()[1], kSign),
          kPower};
}

Printed print_call(const Expression& e) {
  std::string text(function_name(e.operation()));
  char separator = '(';
  for (const Expression& operand : e.operands()) {
    text += separator;
    text += print(operand).text;
    separator = ',';
  }
  text += ')';
  return {std::move(text), kAtom};
}

Printed print_delay(const Expression& e) {
  std::string text = "delay(";
  text += e.name();
  text += ',';
  text += e.operands().empty() ? format_number(e.value()) : print(e.operands()[0]).text;
  text += ')';
  return {std::move(text), kAtom};
}

/// A row of signs stays a row: parentheses would nest deeper than what was written.
Printed print_negated(const Expression& e) {
  std::string text(1, '-');
  text += operand_text(e.operands()[0], kSign);
  return {std::move(text), kSign};
}

Printed print_number(double value) {
  return {format_number(value), std::signbit(value) ? kSign : kAtom};
}

Printed print(const Expression& e) {
  switch (e.operation()) {
    case Operation::Number:
      return print_number(e.value());
    case Operation::Variable:
      return {e.name(), kAtom};
    case Operation::Delay:
      return print_delay(e);
    case Operation::Add:
      return print_sum(e, '+');
    case Operation::Subtract:
      return print_sum(e, '-');
    case Operation::Multiply:
      return print_product(e, '*');
    case Operation::Divide:
      return print_product(e, '/');
    case Operation::Power:
      return print_power(e);
    case Operation::Negate:
      return print_negated(e);
    default:
      return print_call(e);
  }
}

}  // namespace

std::string Expression::to_string() const { return print(*this).text; }

}  // namespace lacuna
