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

/// Which ends: those of the domain, or a rounding inside of it (a root has the slope 1e153 there).
enum class Held { AtEdges, Inside };

Ends ends_of(const Expression& e, Held held) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  const double zero = held == Held::Inside ? kLeast : 0.0;
  const double one =
      held == Held::Inside ? 1.0 - std::numeric_limits<double>::epsilon() / 2.0 : 1.0;
  if (e.operands().empty() || is_number(e.operands()[0])) return {};
  switch (e.operation()) {
    case Operation::Log:
      return {kLeast, {}};
    case Operation::Sqrt:
      return {zero, {}};
    case Operation::Power:
      return is_whole(e.operands()[1]) ? Ends{} : Ends{zero, {}};
    case Operation::Asin:
    case Operation::Acos:
      return {-one, one};
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
  const Ends ends = ends_of(e, Held::AtEdges);
  if (!ends.low) return;
  const Expression& argument = e.operands()[0];
  margins.push_back(ends.high ? argument + 1.0 : argument);
  if (ends.high) margins.push_back(1.0 - argument);
}

Expression with_held(const Expression& e, Held held) {
  if (e.operands().empty() || e.operation() == Operation::Delay) return e;
  std::vector<Expression> operands;
  for (const Expression& operand : e.operands()) operands.push_back(with_held(operand, held));
  operands[0] = held_between(operands[0], ends_of(e, held));
  return Expression::make(e.operation(), std::move(operands));
}

}  // namespace

Expression held_in_domain(const Expression& e) { return with_held(e, Held::AtEdges); }

Expression held_off_edges(const Expression& e) { return with_held(e, Held::Inside); }

std::vector<Expression> domain_margins(const Expression& expression) {
  std::vector<Expression> margins;
  add_margins(expression, margins);
  return margins;
}

}  // namespace lacuna
