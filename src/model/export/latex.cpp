// SPDX-License-Identifier: MIT
#include "model/export/latex.hpp"

#include <cmath>
#include <vector>

#include "core/base/text.hpp"
#include "model/export/dialect.hpp"
#include "model/export/heading.hpp"
#include "model/export/languages.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

enum Tightness { kLoose, kFactor, kWhole };

/// Lines of one align*, which TeX breaks no page in.
constexpr std::size_t kLinesOfOne = 40;

/// Letters of one line; a longer sum goes on in the next.
constexpr std::size_t kLineLetters = 400;

struct Latex {
  std::string text;
  Tightness binding;
};

std::string in_parentheses(const std::string& text) { return "\\left(" + text + "\\right)"; }

/// 1e-05 as 10^{-5}, 2.5e-7 as 2.5\cdot 10^{-7}.
Latex number_text(double value) {
  const std::string text = format_number(value);
  const Tightness sign = text.front() == '-' ? kLoose : kFactor;
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return {text, sign == kLoose ? kLoose : kWhole};
  const std::string digits = text.substr(0, e);
  const std::string power = "10^{" + std::to_string(std::stoi(text.substr(e + 1))) + "}";
  return {digits == "1"    ? power
          : digits == "-1" ? "-" + power
                           : digits + "\\cdot " + power,
          sign};
}

/// x1_d2 as \mathit{x1\_d2}; single letters and letters with digits as x_{1}.
std::string name_text(const std::string& name) {
  const bool begins_with_letter = name.front() != '_';
  if (begins_with_letter && name.size() == 1) return name;
  if (begins_with_letter && name.find_first_not_of("0123456789", 1) == std::string::npos)
    return name.substr(0, 1) + "_{" + name.substr(1) + "}";
  std::string text;
  for (const char c : name) text += c == '_' ? std::string("\\_") : std::string(1, c);
  return "\\mathit{" + text + "}";
}

/// What stands between two factors: a dot where the second begins with a digit.
std::string times(const std::string& second) {
  return second.front() >= '0' && second.front() <= '9' ? "\\cdot " : "\\,";
}

class LatexPrinter {
 public:
  explicit LatexPrinter(const ForeignNames& names) : names_(names) {}

  std::string name(const std::string& variable) const {
    return variable == "t" ? variable : name_text(names_.at(variable));
  }

  Latex print(const Expression& e) const {
    switch (e.operation()) {
      case Operation::Number:
        return number_text(e.value());
      case Operation::Variable:
        return {name(e.name()), kWhole};
      case Operation::Delay:
        check_bound(e);
        return {name(e.name()) + "(t-" + number_text(e.value()).text + ")", kWhole};
      case Operation::Add:
        return {part(e, 0, kLoose) + " + " + part(e, 1, kLoose), kLoose};
      case Operation::Subtract:
        return {part(e, 0, kLoose) + " - " + part(e, 1, kFactor), kLoose};
      case Operation::Multiply:
        return product(part(e, 0, kFactor), part(e, 1, kFactor));
      case Operation::Divide:
        return {"\\frac{" + inner(e, 0) + "}{" + inner(e, 1) + "}", kFactor};
      case Operation::Negate:
        return {"-" + part(e, 0, kFactor), kLoose};
      case Operation::Power:
        return {part(e, 0, kWhole) + "^{" + inner(e, 1) + "}", kFactor};
      default:
        return call(e);
    }
  }

  static Latex product(const std::string& first, const std::string& second) {
    return {first + times(second) + second, kFactor};
  }

 private:
  std::string inner(const Expression& e, std::size_t i) const {
    return print(e.operands()[i]).text;
  }

  std::string part(const Expression& e, std::size_t i, Tightness needed) const {
    const Latex printed = print(e.operands()[i]);
    const bool signed_right = i > 0 && printed.text.front() == '-';
    return printed.binding >= needed && !signed_right ? printed.text
                                                      : in_parentheses(printed.text);
  }

  Latex call(const Expression& e) const {
    if (e.operation() == Operation::Abs) return {"\\left|" + inner(e, 0) + "\\right|", kWhole};
    if (e.operation() == Operation::Sqrt) return {"\\sqrt{" + inner(e, 0) + "}", kWhole};
    const std::string function(function_name(e.operation()));
    std::string operands = inner(e, 0);
    for (std::size_t i = 1; i < e.operands().size(); ++i) operands += ", " + inner(e, i);
    switch (e.operation()) {
      case Operation::Asin:
      case Operation::Acos:
      case Operation::Atan:
        return {"\\arc" + function.substr(1) + in_parentheses(operands), kWhole};
      case Operation::Log:
        return {"\\ln" + in_parentheses(operands), kWhole};
      case Operation::Sign:
      case Operation::Step:
      case Operation::Clip:
        return {"\\operatorname{" + function + "}" + in_parentheses(operands), kWhole};
      default:
        return {"\\" + function + in_parentheses(operands), kWhole};
    }
  }

  const ForeignNames& names_;
};

/// A coefficient's size times its term.
std::string latex_summand(double size, const Term& term, const LatexPrinter& printer) {
  const Latex number = number_text(size);
  if (term.name() == "1") return number.text;
  const Latex printed = printer.print(term.expression());
  const std::string body =
      printed.binding == kLoose ? in_parentheses(printed.text) : printed.text;
  return size == 1.0 ? body : LatexPrinter::product(number.text, body).text;
}

/// The lines of a sum; those behind the first begin with a sign.
std::vector<std::string> latex_lines(const Equation& equation, const LatexPrinter& printer) {
  std::vector<std::string> lines(1);
  for (const auto& [term, coefficient, error, interval, fixed] : equation) {
    const std::string summand = latex_summand(std::abs(coefficient), term, printer);
    check_nesting(summand);
    const bool is_first = lines.back().empty();
    if (!is_first && lines.back().size() > kLineLetters) lines.emplace_back();
    const bool is_negative = std::signbit(coefficient);
    lines.back() += is_first ? (is_negative ? "-" : "") : is_negative ? " - " : " + ";
    lines.back() += summand;
  }
  if (lines.front().empty()) lines.front() = "0";
  return lines;
}

}  // namespace

std::string export_latex(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  const ForeignNames names = foreign_names(model, latex_names());
  const LatexPrinter printer(names);
  std::string text = renamed_lines("% ", model, names) + "\\begin{align*}\n";
  std::size_t row = 0;
  const auto add = [&](const std::string& line) {
    if (row > 0)
      text += row % kLinesOfOne == 0 ? "\n\\end{align*}\n\\begin{align*}\n" : " \\\\\n";
    text += "  " + line;
    ++row;
  };
  for (std::size_t k = 0; k < model.states().size(); ++k) {
    const std::vector<std::string> lines = latex_lines(model.equations()[k], printer);
    add("\\dot{" + printer.name(model.states()[k].name) + "} &= " + lines.front());
    for (std::size_t i = 1; i < lines.size(); ++i) add("&\\quad{}" + lines[i]);
  }
  const auto define = [&](const std::string& name, const std::string& value) {
    check_nesting(value);
    add(printer.name(name) + " &= " + value);
  };
  for (const Output& output : model.outputs())
    define(output.name, printer.print(output.formula).text);
  for (const Parameter& parameter : system.parameters())
    define(parameter.name, number_text(parameter.value).text);
  for (std::size_t k = 0; k < model.states().size(); ++k)
    if (const auto& initial = model.initial()[k])
      add(printer.name(model.states()[k].name) + "(0) &= " + number_text(initial->value).text);
  return text + "\n\\end{align*}\n";
}

}  // namespace lacuna
