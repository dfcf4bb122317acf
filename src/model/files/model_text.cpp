// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include "core/base/text.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "summand_text.hpp"

namespace lacuna {
namespace {

/// Whether a text can follow a factor and a '*' as it is.
bool is_product_text(const Expression& e) {
  switch (e.operation()) {
    case Operation::Add:
    case Operation::Subtract:
      return false;
    default:
      return e.to_string().front() != '-';
  }
}

std::string number_text(double value, std::optional<int> significant_digits) {
  return significant_digits ? format_number(value, *significant_digits) : format_number(value);
}

std::string right_hand_side(const Equation& equation, std::optional<int> significant_digits) {
  std::string text;
  for (const WeightedTerm& summand : equation) {
    if (summand.coefficient == 0.0) continue;
    const bool negative = summand.coefficient < 0.0;
    text += text.empty() ? (negative ? "-" : "") : negative ? " - " : " + ";
    text += summand_text(summand.term.expression(),
                         number_text(std::abs(summand.coefficient), significant_digits),
                         One::LeftOut);
  }
  if (text.empty()) text += '0';
  return text;
}

}  // namespace

std::string summand_text(const Expression& term, std::string factor, One one) {
  if (is_number(term, 1.0)) return factor;
  const bool left_out = factor == "1" && one == One::LeftOut;
  const bool reciprocal =
      term.operation() == Operation::Divide && is_number(term.operands()[0], 1.0);
  std::string text = term.to_string();
  if (left_out && is_product_text(term)) return text;
  if (reciprocal) return factor.append(text, 1);
  if (left_out)
    factor.clear();
  else
    factor += '*';
  if (is_product_text(term)) return factor.append(text);
  return factor.append("(").append(text).append(")");
}

std::string to_text(const OdeModel& model, std::optional<int> significant_digits) {
  std::string text;
  for (std::size_t i = 0; i < model.equations().size(); ++i) {
    if (i > 0) text += '\n';
    text.append(left_hand_side(model.states()[i].name, model.evolution())).append(" = ");
    text += right_hand_side(model.equations()[i], significant_digits);
  }
  return text;
}

}  // namespace lacuna
