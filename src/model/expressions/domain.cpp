// SPDX-License-Identifier: MIT
#include "domain.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "operations.hpp"

namespace lacuna {
namespace {

/// Between which numbers the first argument of an operation is to be.
struct Ends {
  std::optional<double> low = {}, high = {};
};

bool is_whole(const Expression& exponent) {
  const std::optional<double> value = constant_value(exponent);
  return value && *value == std::floor(*value);
}

/// The ends have finite slopes: 1e153 of a root.
Ends ends_of(const Expression& e) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  constexpr double kNearOne = 1.0 - std::numeric_limits<double>::epsilon() / 2.0;
  if (e.operands().empty() || is_number(e.operands()[0])) return {};
  switch (e.operation()) {
    case Operation::Sqrt:
    case Operation::Log:
      return {kLeast, {}};
    case Operation::Power:
      return is_whole(e.operands()[1]) ? Ends{} : Ends{kLeast, {}};
    case Operation::Asin:
    case Operation::Acos:
      return {-kNearOne, kNearOne};
    default:
      return {};
  }
}

Expression held_between(const Expression& e, const Ends& ends) {
  if (!ends.low) return e;
  const Expression raised = Expression::make(Operation::Max, {e, *ends.low});
  return ends.high ? Expression::make(Operation::Min, {raised, *ends.high}) : raised;
}

void add_margins(const Expression& e, std::vector<Expression>& margins) {
  for (const Expression& operand : e.operands()) add_margins(operand, margins);
  const Ends ends = ends_of(e);
  if (!ends.low) return;
  const Expression& argument = e.operands()[0];
  margins.push_back(ends.high ? argument + 1.0 : argument);
  if (ends.high) margins.push_back(1.0 - argument);
}

}  // namespace

Expression held_in_domain(const Expression& e) {
  if (e.operands().empty() || e.operation() == Operation::Delay) return e;
  std::vector<Expression> operands;
  for (const Expression& operand : e.operands()) operands.push_back(held_in_domain(operand));
  operands[0] = held_between(operands[0], ends_of(e));
  return Expression::make(e.operation(), std::move(operands));
}

std::vector<Expression> domain_margins(const Expression& expression) {
  std::vector<Expression> margins;
  add_margins(expression, margins);
  return margins;
}

}  // namespace lacuna
