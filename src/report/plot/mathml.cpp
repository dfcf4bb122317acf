// SPDX-License-Identifier: MIT
#include "report/plot/mathml.hpp"

#include <algorithm>
#include <vector>

#include "core/base/text.hpp"
#include "model/expressions/operations.hpp"
#include "report/pages/readable.hpp"

namespace lacuna {
namespace {

constexpr int kDigits = 4;  // of numbers inside formulas: for people

enum class Binding { Sum, Product, Atom };

Binding binding_of(const Expression& e) {
  switch (e.operation()) {
    case Operation::Number:
      return e.value() < 0.0 ? Binding::Sum : Binding::Atom;
    case Operation::Add:
    case Operation::Subtract:
    case Operation::Negate:
      return Binding::Sum;
    case Operation::Multiply:
    case Operation::Divide:
    case Operation::Power:
      return Binding::Product;
    default:
      return Binding::Atom;
  }
}

/// Whether an operand is written in brackets, for one that binds at least as `needed` is not.
bool is_bracketed(const Expression& e, std::size_t i, Binding needed) {
  const Expression& part = e.operands()[i];
  const bool is_signed = part.operation() == Operation::Negate ||
                         (part.operation() == Operation::Number && part.value() < 0.0);
  return binding_of(part) < needed || (i > 0 && is_signed);
}

Markup print(const Expression& e);

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
  const Markup printed = print(e.operands()[i]);
  return is_bracketed(e, i, needed) ? in_brackets(printed) : printed;
}

/// "sin" as it is applied.
Markup function_markup(const Expression& e) {
  const Operation operation = e.operation();
  const std::string name = operation == Operation::Sign  ? "sgn"
                           : operation == Operation::Log ? "ln"
                                                         : std::string(function_name(operation));
  return element("mi", Markup::text(name)) + Markup::own("<mo>&#x2061;</mo>");
}

Markup call(const Expression& e) {
  if (e.operation() == Operation::Abs)
    return in_row(sign_of("|") + print(e.operands()[0]) + sign_of("|"));
  if (e.operation() == Operation::Sqrt) return element("msqrt", print(e.operands()[0]));
  Markup inner;
  for (const Expression& operand : e.operands())
    inner += (inner.empty() ? Markup() : sign_of(",")) + print(operand);
  return in_row(function_markup(e) + in_brackets(inner));
}

Markup delayed(const Expression& e) {
  const Markup past = element("mi", Markup::text("t")) + sign_of("\u2212") +
                      (e.operands().empty() ? number_markup(format_number(e.value(), kDigits))
                                            : print(e.operands()[0]));
  return in_row(name_markup(e.name()) + in_brackets(past));
}

Markup binary(const Expression& e, const Markup& sign, Binding left, Binding right) {
  return in_row(part(e, 0, left) + sign + part(e, 1, right));
}

Markup print(const Expression& e) {
  switch (e.operation()) {
    case Operation::Number:
      return number_markup(format_number(e.value(), kDigits));
    case Operation::Variable:
      return name_markup(e.name());
    case Operation::Delay:
      return delayed(e);
    case Operation::Add:
      return binary(e, sign_of("+"), Binding::Sum, Binding::Sum);
    case Operation::Subtract:
      return binary(e, sign_of("\u2212"), Binding::Sum, Binding::Product);
    case Operation::Multiply:
      return binary(e, thin_space(), Binding::Product, Binding::Product);
    case Operation::Divide:
      return element("mfrac",
                     in_row(print(e.operands()[0])) + in_row(print(e.operands()[1])));
    case Operation::Negate:
      return in_row(sign_of("\u2212") + part(e, 0, Binding::Product));
    case Operation::Power:
      return element("msup", part(e, 0, Binding::Atom) + in_row(print(e.operands()[1])));
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

/// Parts of a formula between which a line may end.
using Pieces = std::vector<Markup>;

/// Both, without a break between the last of the one and the first of the other.
Pieces glued(Pieces left, const Pieces& right) {
  left.back() += right.front();
  left.insert(left.end(), right.begin() + 1, right.end());
  return left;
}

Pieces followed(Pieces left, const Pieces& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

Pieces between(const std::string& open, const Pieces& content, const std::string& close) {
  return glued(glued({sign_of(open)}, content), {sign_of(close)});
}

/// Characters of a formula, of a fraction those of its longer part.
std::size_t shown_length(const Expression& e) {
  if (e.operation() == Operation::Number) return format_number(e.value(), kDigits).size();
  std::size_t sum = e.operation() == Operation::Variable || e.operation() == Operation::Delay
                        ? e.name().size()
                        : function_name(e.operation()).size();
  std::size_t longest = 0;
  for (const Expression& operand : e.operands()) {
    const std::size_t length = shown_length(operand);
    longest = std::max(longest, length);
    sum += length + 1;
  }
  return e.operation() == Operation::Divide ? longest : sum;
}

Pieces pieces_of(const Expression& e);

Pieces part_pieces(const Expression& e, std::size_t i, Binding needed) {
  const Pieces parts = pieces_of(e.operands()[i]);
  return is_bracketed(e, i, needed) ? between("(", parts, ")") : parts;
}

Pieces call_pieces(const Expression& e) {
  if (e.operation() == Operation::Abs) return between("|", pieces_of(e.operands()[0]), "|");
  const bool is_root = e.operation() == Operation::Sqrt;
  Pieces arguments = pieces_of(e.operands()[0]);
  for (std::size_t i = 1; i < e.operands().size(); ++i)
    arguments = followed(glued(arguments, {sign_of(",")}), pieces_of(e.operands()[i]));
  return glued({is_root ? sign_of("\u221a") : function_markup(e)}, between("(", arguments, ")"));
}

/// What fits into a line of a phone is one piece; what is longer may break at its operations.
Pieces pieces_of(const Expression& e) {
  constexpr std::size_t kWhole = 28;  // characters, for people
  if (shown_length(e) <= kWhole || e.operands().empty()) return {in_row(print(e))};
  const auto joined = [&](const Markup& sign, Binding left, Binding right) {
    return followed(part_pieces(e, 0, left), glued({sign}, part_pieces(e, 1, right)));
  };
  switch (e.operation()) {
    case Operation::Add:
      return joined(leading_sign(false, false), Binding::Sum, Binding::Sum);
    case Operation::Subtract:
      return joined(leading_sign(true, false), Binding::Sum, Binding::Product);
    case Operation::Multiply:
      return joined(thin_space(), Binding::Product, Binding::Product);
    case Operation::Divide:
      return joined(sign_of("/"), Binding::Product, Binding::Atom);
    case Operation::Negate:
      return glued({sign_of("\u2212")}, part_pieces(e, 0, Binding::Product));
    case Operation::Power: {
      Pieces base = part_pieces(e, 0, Binding::Atom);
      base.back() = element("msup", in_row(base.back()) + in_row(print(e.operands()[1])));
      return base;
    }
    case Operation::Delay:
      return {print(e)};
    default:
      return call_pieces(e);
  }
}

/// "- 0.4 sgn(w)", without the sign where it is the first and positive.
Pieces summand_pieces(const WeightedTerm& summand, bool first) {
  std::string number = coefficient_text(summand);
  const bool negative = number.front() == '-';
  if (negative) number.erase(0, 1);
  Markup front = first && !negative ? Markup() : leading_sign(negative, first);
  if (summand.term.name() == "1") return {front + number_markup(number)};
  if (number != "1") front += number_markup(number) + thin_space();
  const Expression& formula = summand.term.expression();
  const Pieces parts = pieces_of(formula);
  return glued({front},
               binding_of(formula) == Binding::Sum ? between("(", parts, ")") : parts);
}

Markup formula_of(const Markup& content) {
  return element("math", {{"displaystyle", "true"}}, in_row(content));
}

/// A term of an equation; a blank lets the next one begin a line.
Markup term_markup(const Pieces& pieces, bool is_new) {
  Markup all;
  for (const Markup& piece : pieces)
    all += (all.empty() ? Markup() : empty_element("wbr", {})) + formula_of(piece);
  return element("span", {{"class", is_new ? "term new" : "term"}}, all) + Markup::text(" ");
}

Markup right_hand_side(const OdeModel& model, Index k, const TermNames& fresh) {
  const Equation& equation = model.equations()[static_cast<std::size_t>(k)];
  if (equation.empty()) return term_markup({number_markup("0")}, false);
  Markup all;
  for (std::size_t j = 0; j < equation.size(); ++j)
    all += term_markup(summand_pieces(equation[j], j == 0),
                       fresh.contains({k, equation[j].term.name()}));
  return all;
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
  return element("math", in_row(print(expression)));
}

Markup equations_mathml(const OdeModel& model, const TermNames& fresh) {
  Markup all;
  for (Index k = 0; k < model.dimension(); ++k) {
    const Markup left = left_hand_side_markup(model.states()[static_cast<std::size_t>(k)].name,
                                              model.evolution());
    all += element("div", {{"class", "equation"}},
                   formula_of(left + sign_of("=")) +
                       element("div", {{"class", "terms"}}, right_hand_side(model, k, fresh)));
  }
  return all;
}

}  // namespace lacuna
