// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vector>

#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {
namespace {

/// The time by which a Delay is late.
Expression time_of(const Expression& delayed) {
  return delayed.operands().empty() ? Expression::number(delayed.value())
                                    : delayed.operands()[0];
}

Expression sum_of(const Expression& a, const Expression& b) {
  return is_number(a) && is_number(b) ? Expression::number(a.value() + b.value()) : a + b;
}

/// The operation on what `change` makes of its operands.
template <class Change>
Expression rebuilt(const Expression& e, Change change) {
  if (e.operands().empty()) return e;
  std::vector<Expression> operands;
  for (const Expression& operand : e.operands()) operands.push_back(change(operand));
  if (std::equal(operands.begin(), operands.end(), e.operands().begin())) return e;
  return Expression::make(e.operation(), std::move(operands));
}

}  // namespace

Expression delay(const Expression& expression, const Expression& time) {
  switch (expression.operation()) {
    case Operation::Variable:
      return Expression::delayed(expression.name(), time);
    case Operation::Delay:
      return Expression::delayed(expression.name(), sum_of(time_of(expression), time));
    default:
      return rebuilt(expression, [&](const Expression& e) { return delay(e, time); });
  }
}

Expression substitute(const Expression& expression,
                      const std::map<std::string, Expression>& replacements) {
  const auto changed = [&](const Expression& e) { return substitute(e, replacements); };
  const bool delayed = expression.operation() == Operation::Delay;
  if (!delayed && expression.operation() != Operation::Variable)
    return rebuilt(expression, changed);
  const auto found = replacements.find(expression.name());
  const Expression now =
      found != replacements.end() ? found->second : Expression::variable(expression.name());
  return delayed ? delay(now, changed(time_of(expression))) : now;
}

bool contains(const Expression& expression, Operation operation) {
  return expression.operation() == operation ||
         std::any_of(expression.operands().begin(), expression.operands().end(),
                     [&](const Expression& e) { return contains(e, operation); });
}

}  // namespace lacuna
