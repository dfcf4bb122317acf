// SPDX-License-Identifier: MIT
#include "model/export/dialect.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/text.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

/// Words of C, C++, Python, MATLAB and Modelica that are short enough to be somebody's state.
constexpr std::array<std::string_view, 41> kWords = {
    "and",   "as",     "auto",   "bool",  "break", "case",   "char", "class",  "const",
    "def",   "del",    "delete", "der",   "do",    "double", "else", "end",    "enum",
    "flow",  "float",  "for",    "goto",  "if",    "import", "in",   "inline", "int",
    "is",    "lambda", "long",   "model", "new",   "not",    "np",   "or",     "register",
    "short", "signed", "this",   "time",  "while"};

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
        return {number(e.value()), e.value() < 0.0 ? kSign : kAtom};
      case Operation::Variable:
        return {variable(e.name()), kAtom};
      case Operation::Delay:
        return delay(e);
      case Operation::Add:
        return {part(e, 0, kSum) + " + " + right(e, kSum), kSum};
      case Operation::Subtract:
        return {part(e, 0, kSum) + " - " + right(e, kProduct), kSum};
      case Operation::Multiply:
        return {part(e, 0, kProduct) + "*" + right(e, kProduct), kProduct};
      case Operation::Divide:
        return {part(e, 0, kProduct) + "/" + right(e, kPower), kProduct};
      case Operation::Negate:
        return {"-" + part(e, 0, kPower), kSign};
      case Operation::Power:
        return power(e);
      default:
        return call(e);
    }
  }

 private:
  std::string variable(const std::string& name) const {
    const bool has_own = dialect_.variable && name != "t";
    return has_own ? dialect_.variable(name) : code_name(name, dialect_);
  }

  std::string number(double value) const {
    std::string text = format_number(value);
    if (dialect_.numbers_need_a_point && text.find_first_of(".e") == std::string::npos)
      text += ".0";
    return text;
  }

  std::string part(const Expression& e, std::size_t i, Binding needed) const {
    Printed printed = print(e.operands()[i]);
    return printed.binding >= needed ? printed.text : "(" + printed.text + ")";
  }

  /// The second operand; what begins with a sign stands in parentheses.
  std::string right(const Expression& e, Binding needed) const {
    const std::string text = part(e, 1, needed);
    return text.front() == '-' ? "(" + text + ")" : text;
  }

  Printed power(const Expression& e) const {
    if (dialect_.power) return {dialect_.power(e.operands()[0], e.operands()[1]), kAtom};
    return {part(e, 0, kAtom) + dialect_.power_sign + part(e, 1, kAtom), kPower};
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
    return {"delay(" + code_name(e.name(), dialect_) + ", " + number(e.value()) + ")", kAtom};
  }

  const Dialect& dialect_;
};

}  // namespace

std::function<std::string(const std::vector<std::string>&)> called(std::string function) {
  return [function = std::move(function)](const std::vector<std::string>& operands) {
    return function + "(" + join(operands, ", ") + ")";
  };
}

std::string code(const Expression& formula, const Dialect& dialect) {
  return Printer(dialect).print(formula).text;
}

std::string code_name(const std::string& variable, const Dialect& dialect) {
  if (variable == "t") return dialect.time;
  const bool is_word = std::find(kWords.begin(), kWords.end(), variable) != kWords.end();
  return is_word ? variable + "_" : variable;
}

}  // namespace lacuna
