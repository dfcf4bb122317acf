// SPDX-License-Identifier: MIT
#include "report/plot/mathml.hpp"

#include <vector>

#include "core/base/text.hpp"
#include "model/expressions/operations.hpp"
#include "report/pages/readable.hpp"

namespace lacuna {
namespace {

enum class Binding { Sum, Product, Atom };

struct Printed {
  Markup markup;
  Binding binding = Binding::Atom;
  bool is_signed = false;
};

Printed print(const Expression& e);

Markup sign_of(const std::string& text) { return element("mo", Markup::text(text)); }

Markup thin_space() { return empty_element("mspace", {{"width", "0.2em"}}); }

Markup in_row(const Markup& content) { return element("mrow", content); }

Markup in_brackets(const Markup& content) {
  return in_row(sign_of("(") + content + sign_of(")"));
}

/// 1e-05 as 10 to the -5, 2.5e-7 as 2.5 times that.
Markup number_markup(const std::string& text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return element("mn", Markup::text(text));
  const std::string power = std::to_string(std::stoi(text.substr(e + 1)));
  return in_row(
      element("mn", Markup::text(text.substr(0, e))) + sign_of("\u00d7") +
      element("msup", element("mn", Markup::text("10")) + element("mn", Markup::text(power))));
}

/// x1 with an index; longer names as they are.
Markup name_markup(const std::string& name) {
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits == 1 && name.find_first_not_of("0123456789", 1) == std::string::npos)
    return element("msub", element("mi", Markup::text(name.substr(0, 1))) +
                               element("mn", Markup::text(name.substr(1))));
  return element("mi", Markup::text(name));
}

Markup part(const Expression& e, std::size_t i, Binding needed) {
  const Printed printed = print(e.operands()[i]);
  const bool signed_right = i > 0 && printed.is_signed;
  return printed.binding >= needed && !signed_right ? printed.markup
                                                    : in_brackets(printed.markup);
}

std::string shown_name(Operation operation) {
  return operation == Operation::Sign  ? "sgn"
         : operation == Operation::Log ? "ln"
                                       : std::string(function_name(operation));
}

Printed call(const Expression& e) {
  if (e.operation() == Operation::Abs)
    return {in_row(sign_of("|") + print(e.operands()[0]).markup + sign_of("|"))};
  if (e.operation() == Operation::Sqrt)
    return {element("msqrt", print(e.operands()[0]).markup)};
  Markup inner;
  for (const Expression& operand : e.operands())
    inner += (inner.empty() ? Markup() : sign_of(",")) + print(operand).markup;
  return {in_row(element("mi", Markup::text(shown_name(e.operation()))) +
                 Markup::own("<mo>&#x2061;</mo>") + in_brackets(inner))};
}

Markup delayed(const Expression& e) {
  const Markup past = element("mi", Markup::text("t")) + sign_of("\u2212") +
                      (e.operands().empty() ? number_markup(format_number(e.value(), 5))
                                            : print(e.operands()[0]).markup);
  return in_row(name_markup(e.name()) + in_brackets(past));
}

Printed binary(const Expression& e, const std::string& sign, Binding left, Binding right) {
  return {in_row(part(e, 0, left) + sign_of(sign) + part(e, 1, right)), left};
}

Printed print(const Expression& e) {
  switch (e.operation()) {
    case Operation::Number:
      return {number_markup(format_number(e.value(), 5)),
              e.value() < 0.0 ? Binding::Sum : Binding::Atom, e.value() < 0.0};
    case Operation::Variable:
      return {name_markup(e.name())};
    case Operation::Delay:
      return {delayed(e)};
    case Operation::Add:
      return binary(e, "+", Binding::Sum, Binding::Sum);
    case Operation::Subtract:
      return binary(e, "\u2212", Binding::Sum, Binding::Product);
    case Operation::Multiply:
      return {
          in_row(part(e, 0, Binding::Product) + thin_space() + part(e, 1, Binding::Product)),
          Binding::Product};
    case Operation::Divide:
      return {element("mfrac", in_row(print(e.operands()[0]).markup) +
                                   in_row(print(e.operands()[1]).markup)),
              Binding::Product};
    case Operation::Negate:
      return {in_row(sign_of("\u2212") + part(e, 0, Binding::Product)), Binding::Sum, true};
    case Operation::Power:
      return {
          element("msup", part(e, 0, Binding::Atom) + in_row(print(e.operands()[1]).markup)),
          Binding::Product};
    default:
      return call(e);
  }
}

/// The sign in front of a summand, which belongs to it and yet stands between two.
Markup leading_sign(bool negative, bool first) {
  const std::string space = first ? "0em" : "0.28em";
  return element("mo", {{"form", "infix"}, {"lspace", space}, {"rspace", space}},
                 Markup::text(negative ? "\u2212" : "+"));
}

/// "- 0.4 sgn(w)", without the sign where it is the first and positive.
Markup summand_markup(const WeightedTerm& summand, bool first) {
  std::string number = coefficient_text(summand);
  const bool negative = number.front() == '-';
  if (negative) number.erase(0, 1);
  Markup all = first && !negative ? Markup() : leading_sign(negative, first);
  if (summand.term.name() == "1") return all + number_markup(number);
  if (number != "1") all += number_markup(number) + thin_space();
  const Printed printed = print(summand.term.expression());
  return all + (printed.binding == Binding::Sum ? in_brackets(printed.markup) : printed.markup);
}

/// The terms of an equation in lines of a few, which narrow screens can show.
std::vector<Markup> right_hand_side(const OdeModel& model, Index k, const TermNames& fresh) {
  constexpr std::size_t kTermsOfLine = 5;
  const Equation& equation = model.equations()[static_cast<std::size_t>(k)];
  if (equation.empty()) return {number_markup("0")};
  std::vector<Markup> lines;
  for (std::size_t j = 0; j < equation.size(); ++j) {
    const Markup one = summand_markup(equation[j], j == 0);
    if (j % kTermsOfLine == 0) lines.emplace_back();
    lines.back() += fresh.contains({k, equation[j].term.name()})
                        ? element("mrow", {{"class", "new"}}, one)
                        : in_row(one);
  }
  return lines;
}

/// dx/dt, or x with the index n + 1 of a map.
Markup left_hand_side_markup(const std::string& state, Evolution evolution) {
  const Markup name = name_markup(state);
  if (evolution == Evolution::Map)
    return element("msub", in_row(name) + in_row(element("mi", Markup::text("n")) +
                                                 sign_of("+") + number_markup("1")));
  const Markup d = element("mi", {{"mathvariant", "normal"}}, Markup::text("d"));
  return element("mfrac", in_row(d + name) + in_row(d + element("mi", Markup::text("t"))));
}

}  // namespace

Markup to_mathml(const Expression& expression) {
  return element("math", in_row(print(expression).markup));
}

Markup equations_mathml(const OdeModel& model, const TermNames& fresh) {
  Markup rows;
  for (Index k = 0; k < model.dimension(); ++k) {
    const Markup left = left_hand_side_markup(model.states()[static_cast<std::size_t>(k)].name,
                                              model.evolution());
    bool first = true;
    for (const Markup& line : right_hand_side(model, k, fresh)) {
      rows += element("mtr", element("mtd", first ? left : Markup()) +
                                 element("mtd", first ? sign_of("=") : Markup()) +
                                 element("mtd", in_row(line)));
      first = false;
    }
  }
  return element("math", {{"display", "block"}},
                 element("mtable", {{"displaystyle", "true"}}, rows));
}

}  // namespace lacuna
