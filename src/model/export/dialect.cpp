// SPDX-License-Identifier: MIT
#include "model/export/dialect.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

/// Python takes 200, TeX 255, clang 256.
constexpr int kDeepestNesting = 150;

/// How tightly the outermost operation of a text binds.
enum Binding { kSum, kProduct, kSign, kPower, kAtom };

struct Printed {
  std::string text;
  Binding binding;
};

class Printer {
 public:
  explicit Printer(const Dialect& dialect) : dialect_(dialect) {}

  Printed print(const Expression& e) const {
    switch (e.operation()) {
      case Operation::Number:
        return number(e.value());
      case Operation::Variable:
        return {variable(e.name()), kAtom};
      case Operation::Delay:
        return delay(e);
      case Operation::Add:
        return {part(e, 0, kSum) + " + " + right(e, kProduct), kSum};
      case Operation::Subtract:
        return {part(e, 0, kSum) + " - " + right(e, kProduct), kSum};
      case Operation::Multiply:
        return {part(e, 0, kProduct) + "*" + right(e, kPower), kProduct};
      case Operation::Divide:
        return {first(e, kProduct) + "/" + right(e, kPower), kProduct};
      case Operation::Negate:
        return {"-" + part(e, 0, kPower), kSign};
      case Operation::Power:
        return power(e);
      default:
        return call(e);
    }
  }

  Printed number(double value) const {
    const std::string text = dialect_.number(value);
    return {text, text.front() == '-' ? kSign : kAtom};
  }

  /// A printed text as an operand, in parentheses where it binds less or begins with a sign.
  static std::string operand(const Printed& printed, Binding needed) {
    const bool fits = printed.binding >= needed && printed.text.front() != '-';
    return fits ? printed.text : "(" + printed.text + ")";
  }

 private:
  std::string variable(const std::string& name) const {
    if (dialect_.node.empty() || name == "t") return code_name(name, dialect_);
    return dialect_.node + "(" + code_name(name, dialect_) + ")";
  }

  std::string part(const Expression& e, std::size_t i, Binding needed) const {
    Printed printed = print(e.operands()[i]);
    return printed.binding >= needed ? printed.text : "(" + printed.text + ")";
  }

  std::string right(const Expression& e, Binding needed) const {
    return operand(print(e.operands()[1]), needed);
  }

  /// The first operand of a quotient or a power.
  std::string first(const Expression& e, Binding needed) const {
    if (dialect_.scalar.empty() || !e.variables().empty()) return part(e, 0, needed);
    return dialect_.scalar + "(" + print(e.operands()[0]).text + ")";
  }

  /// A power of 1/2 is the root, as in compiled models: they differ at minus infinity.
  Printed power(const Expression& e) const {
    const Expression& exponent = e.operands()[1];
    if (exponent.operation() == Operation::Number && exponent.value() == 0.5)
      return call(Expression::make(Operation::Sqrt, {e.operands()[0]}));
    if (dialect_.power)
      return {dialect_.power(print(e.operands()[0]).text, print(exponent).text, exponent),
              kAtom};
    const std::string text = first(e, kAtom) + dialect_.power_sign + part(e, 1, kAtom);
    if (dialect_.real.empty() || is_whole_number(exponent)) return {text, kPower};
    return {dialect_.real + "(" + text + ")", kAtom};
  }

  Printed call(const Expression& e) const {
    std::vector<std::string> operands;
    for (const Expression& operand : e.operands()) operands.push_back(print(operand).text);
    const auto own = dialect_.calls.find(e.operation());
    if (own != dialect_.calls.end()) return {own->second(operands), kAtom};
    return {called(std::string(function_name(e.operation())))(operands), kAtom};
  }

  Printed delay(const Expression& e) const {
    if (!dialect_.has_delay)
      throw ModelError(e.to_string(), dialect_.name + " has no delay",
                       "export to modelica, or replace the delay");
    check_bound(e);
    return {"delay(" + variable(e.name()) + ", " + dialect_.number(e.value()) + ")", kAtom};
  }

  const Dialect& dialect_;
};

/// Beyond it (c*x)*y and c*(x*y) may differ in what a double holds.
bool is_extreme(double coefficient) {
  // Facts of doubles: products of such a coefficient may leave their range.
  constexpr double kSmall = 1e-100, kLarge = 1e100;
  return std::abs(coefficient) < kSmall || std::abs(coefficient) > kLarge;
}

/// A coefficient times its term.
Printed summand_code(double coefficient, const Term& term, const Printer& printer) {
  if (term.name() == "1") return printer.number(coefficient);
  const Printed printed = printer.print(term.expression());
  if (coefficient == 1.0) return printed;
  if (coefficient == -1.0) return {"-" + Printer::operand(printed, kPower), kSign};
  const Binding needed = is_extreme(coefficient) ? kPower : kProduct;
  return {printer.number(coefficient).text + "*" + Printer::operand(printed, needed), kProduct};
}

}  // namespace

std::function<std::string(const std::vector<std::string>&)> called(std::string function) {
  return [function = std::move(function)](const std::vector<std::string>& operands) {
    return function + "(" + join(operands, ", ") + ")";
  };
}

std::string number_with_point(double value) {
  std::string text = format_number(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

bool is_whole_number(const Expression& formula) {
  return is_number(formula) && formula.value() == std::floor(formula.value());
}

void check_bound(const Expression& delay) {
  if (delay.operands().empty()) return;
  throw ModelError(delay.to_string(), "the time of the delay is no number",
                   "give its parameters numbers: SystemModel::model()");
}

void check_nesting(const std::string& code) {
  int depth = 0, deepest = 0;
  for (const char c : code) {
    if (c == '(' || c == '{' || c == '[') deepest = std::max(deepest, ++depth);
    if (c == ')' || c == '}' || c == ']') --depth;
  }
  if (deepest > kDeepestNesting)
    throw ModelError("export",
                     "a formula nests parentheses " + std::to_string(deepest) +
                         " deep, and compilers take " + std::to_string(kDeepestNesting),
                     "make a part of it a state or an input");
}

std::string code(const Expression& formula, const Dialect& dialect) {
  std::string text = Printer(dialect).print(formula).text;
  check_nesting(text);
  return text;
}

std::string code(const Equation& equation, const Dialect& dialect) {
  const Printer printer(dialect);
  std::string text;
  for (const auto& [term, coefficient, error, interval, fixed] : equation) {
    const bool subtracted = !text.empty() && coefficient < 0.0;
    const Printed summand =
        summand_code(subtracted ? -coefficient : coefficient, term, printer);
    if (text.empty())
      text = summand.text;
    else
      text += (subtracted ? " - " : " + ") + Printer::operand(summand, kProduct);
  }
  if (text.empty()) return dialect.number(0.0);
  check_nesting(text);
  return text;
}

std::string code_name(const std::string& variable, const Dialect& dialect) {
  return variable == "t" ? dialect.time : dialect.names.at(variable);
}

}  // namespace lacuna
