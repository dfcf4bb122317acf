// SPDX-License-Identifier: MIT
#include "model/export/latex.hpp"

#include <cmath>

#include "lacuna/core/base/text.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

enum Tightness { kLoose, kFactor, kWhole };

struct Latex {
  std::string text;
  Tightness binding;
};

Latex print(const Expression& e);

std::string in_parentheses(const std::string& text) { return "\\left(" + text + "\\right)"; }

std::string part(const Expression& e, std::size_t i, Tightness needed) {
  const Latex printed = print(e.operands()[i]);
  const bool signed_right = i > 0 && printed.text.front() == '-';
  return printed.binding >= needed && !signed_right ? printed.text
                                                    : in_parentheses(printed.text);
}

/// 1e-05 as 10^{-5}, 2.5e-7 as 2.5\cdot 10^{-7}.
std::string number_text(double value) {
  const std::string text = format_number(value);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  const std::string digits = text.substr(0, e);
  const std::string power = "10^{" + std::to_string(std::stoi(text.substr(e + 1))) + "}";
  return digits == "1" ? power : digits + "\\cdot " + power;
}

/// x1_d2 as \mathit{x1\_d2}; single letters and letters with digits as x_{1}.
std::string name_text(const std::string& name) {
  const std::size_t digits = name.find_first_of("0123456789");
  if (name.size() == 1) return name;
  if (digits == 1 && name.find_first_not_of("0123456789", 1) == std::string::npos)
    return name.substr(0, 1) + "_{" + name.substr(1) + "}";
  std::string text;
  for (const char c : name) text += c == '_' ? std::string("\\_") : std::string(1, c);
  return "\\mathit{" + text + "}";
}

Latex call(const Expression& e) {
  if (e.operation() == Operation::Abs)
    return {"\\left|" + print(e.operands()[0]).text + "\\right|", kWhole};
  if (e.operation() == Operation::Sqrt)
    return {"\\sqrt{" + print(e.operands()[0]).text + "}", kWhole};
  const std::string name(function_name(e.operation()));
  std::string operands;
  for (const Expression& operand : e.operands())
    operands += (operands.empty() ? "" : ", ") + print(operand).text;
  switch (e.operation()) {
    case Operation::Asin:
    case Operation::Acos:
    case Operation::Atan:
      return {"\\arc" + name.substr(1) + in_parentheses(operands), kWhole};
    case Operation::Sign:
    case Operation::Step:
    case Operation::Clip:
      return {"\\operatorname{" + name + "}" + in_parentheses(operands), kWhole};
    default:
      return {"\\" + name + in_parentheses(operands), kWhole};
  }
}

Latex print(const Expression& e) {
  switch (e.operation()) {
    case Operation::Number:
      return {number_text(e.value()), e.value() < 0.0 ? kLoose : kWhole};
    case Operation::Variable:
      return {name_text(e.name()), kWhole};
    case Operation::Delay:
      return {name_text(e.name()) + "(t-" + number_text(e.value()) + ")", kWhole};
    case Operation::Add:
      return {part(e, 0, kLoose) + " + " + part(e, 1, kLoose), kLoose};
    case Operation::Subtract:
      return {part(e, 0, kLoose) + " - " + part(e, 1, kFactor), kLoose};
    case Operation::Multiply:
      return {part(e, 0, kFactor) + "\\," + part(e, 1, kFactor), kFactor};
    case Operation::Divide:
      return {
          "\\frac{" + print(e.operands()[0]).text + "}{" + print(e.operands()[1]).text + "}",
          kFactor};
    case Operation::Negate:
      return {"-" + part(e, 0, kFactor), kLoose};
    case Operation::Power:
      return {part(e, 0, kWhole) + "^{" + print(e.operands()[1]).text + "}", kFactor};
    default:
      return call(e);
  }
}

std::string latex_sum(const Equation& equation) {
  std::string text;
  for (const WeightedTerm& summand : equation) {
    const bool negative = summand.coefficient < 0.0;
    text += text.empty() ? (negative ? "-" : "") : negative ? " - " : " + ";
    const double size = std::abs(summand.coefficient);
    const Expression& term = summand.term.expression();
    const Latex printed = print(term);
    const std::string body =
        printed.binding == kLoose ? in_parentheses(printed.text) : printed.text;
    if (summand.term.name() == "1")
      text += number_text(size);
    else
      text += size == 1.0 ? body : number_text(size) + "\\," + body;
  }
  return text.empty() ? "0" : text;
}

}  // namespace

std::string export_latex(const OdeModel& model) {
  std::string text = "\\begin{align*}\n";
  for (std::size_t k = 0; k < model.states().size(); ++k) {
    text += "  \\dot{" + name_text(model.states()[k].name) +
            "} &= " + latex_sum(model.equations()[k]);
    text += k + 1 < model.states().size() ? " \\\\\n" : "\n";
  }
  return text + "\\end{align*}\n";
}

}  // namespace lacuna
