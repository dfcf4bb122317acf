// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "data/units/in_units.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

const Equation& terms_of(const OdeModel& model, Index equation) {
  return model.equations()[static_cast<std::size_t>(equation)];
}

bool varies(const Expression& expression) { return !expression.variables().empty(); }

bool is_whole_power(const Expression& x) {
  return x.operation() == Operation::Power &&
         x.operands()[1].operation() == Operation::Number && x.operands()[1].value() >= 2.0 &&
         x.operands()[1].value() == std::floor(x.operands()[1].value());
}

Expression product_of(const std::vector<Expression>& factors) {
  Expression product = factors.front();
  for (std::size_t i = 1; i < factors.size(); ++i) product = product * factors[i];
  return product;
}

/// What a product is made of, powers as they are.
std::vector<Expression> operands_of(const Expression& product) {
  if (product.operation() != Operation::Multiply) return {product};
  std::vector<Expression> all = operands_of(product.operands()[0]);
  for (Expression& factor : operands_of(product.operands()[1])) all.push_back(std::move(factor));
  return all;
}

/// A power with one factor less.
Expression lowered(const Expression& power) {
  const Expression& x = power.operands()[0];
  const double less = power.operands()[1].value() - 1.0;
  return less > 1.0 ? Expression::make(Operation::Power, {x, Expression::number(less)}) : x;
}

/// The factors of a product one by one, those of a power with the rest of it.
void collect_factors(const Expression& product, const std::vector<Expression>& beside,
                     std::vector<TermFactor>& result) {
  const auto with = [&](const Expression& more) {
    std::vector<Expression> all = beside;
    all.push_back(more);
    return all;
  };
  if (product.operation() == Operation::Multiply) {
    const Expression &a = product.operands()[0], &b = product.operands()[1];
    collect_factors(a, with(b), result);
    collect_factors(b, with(a), result);
  } else if (is_whole_power(product)) {
    result.push_back({product.operands()[0], product_of(with(lowered(product)))});
  } else if (varies(product) && !beside.empty()) {
    result.push_back({product, product_of(beside)});
  }
}

double coefficient_of(const OdeModel& model, Index equation, const Expression& term) {
  return model.coefficient(equation, Term(term, model.variables()).name());
}

}  // namespace

bool has_term(const Scope& scope, Index equation, const Expression& term) {
  const std::string name = Term(term, scope.model.variables()).name();
  const Equation& terms = terms_of(scope.model, equation);
  return std::any_of(terms.begin(), terms.end(),
                     [&](const WeightedTerm& summand) { return summand.term.name() == name; });
}

double slope(const OdeModel& model, Index equation, const Expression& argument) {
  const double whole = coefficient_of(model, equation, argument);
  if (whole != 0.0 || !is_difference(argument)) return whole;
  const Expression &a = argument.operands()[0], &b = argument.operands()[1];
  const double reversed = coefficient_of(model, equation, b - a);
  if (reversed != 0.0) return -reversed;
  // What a has more than b acts on it alone: a spring to the ground.
  const double own = coefficient_of(model, equation, a);
  const double other = coefficient_of(model, equation, b);
  const bool opposite = own * other < 0.0;
  return opposite ? std::copysign(std::min(std::abs(own), std::abs(other)), own) : own;
}

bool is_variable(const Expression& expression) {
  return expression.operation() == Operation::Variable;
}

bool is_difference(const Expression& expression) {
  return expression.operation() == Operation::Subtract &&
         std::all_of(expression.operands().begin(), expression.operands().end(), is_variable);
}

Expression own_state(const Scope& scope, Index equation) {
  return Expression::variable(scope.state(equation).name);
}

bool is_position(const Scope& scope, Index equation, const Expression& expression) {
  const auto position = scope.integral_of(equation);
  return position && expression == own_state(scope, *position);
}

bool is_velocity(const Scope& scope, Index equation) {
  return scope.integral_of(equation).has_value();
}

bool is_input(const Scope& scope, const Expression& expression) {
  return is_variable(expression) &&
         std::any_of(scope.variables.begin(), scope.variables.end(), [&](const auto& variable) {
           return variable.is_input && variable.name == expression.name();
         });
}

bool in_other_part(const Scope& scope, Index equation, const Expression& state) {
  const Index m = scope.model.dimension();
  std::vector<Index> part(static_cast<std::size_t>(m));
  for (Index k = 0; k < m; ++k) part[static_cast<std::size_t>(k)] = k;
  const auto join_parts = [&](Index a, Index b) {
    const Index from = part[static_cast<std::size_t>(a)],
                to = part[static_cast<std::size_t>(b)];
    std::replace(part.begin(), part.end(), from, to);
  };
  for (Index k = 0; k < m; ++k)
    for (const WeightedTerm& summand : terms_of(scope.model, k))
      for (Index j = 0; j < m; ++j)
        if (summand.term.expression().variables().contains(scope.state(j).name))
          join_parts(k, j);
  for (Index j = 0; j < m; ++j)
    if (own_state(scope, j) == state)
      return part[static_cast<std::size_t>(j)] != part[static_cast<std::size_t>(equation)];
  return false;
}

double shortest_period(const Scope& scope) {
  double shortest = scope.duration;
  for (const VariableRange& variable : scope.variables)
    if (!variable.is_input) shortest = std::min(shortest, variable.period);
  return shortest;
}

bool determines_time(const Scope& scope) {
  return kFewestPeriods * shortest_period(scope) <= scope.duration;
}

std::vector<Expression> all_variables(const Scope& scope) {
  std::vector<Expression> all;
  for (const VariableRange& variable : scope.variables)
    all.push_back(Expression::variable(variable.name));
  return all;
}

namespace {

bool are_opposite(const WeightedTerm& one, const WeightedTerm& other) {
  // A decision (docs/decisions.md): numbers that were written by hand or fitted.
  constexpr double kDifferenceOfSizes = 0.01;
  const double a = one.coefficient, b = other.coefficient;
  return is_variable(one.term.expression()) && is_variable(other.term.expression()) &&
         std::abs(a + b) <= kDifferenceOfSizes * std::abs(a - b);
}

/// Whether an equation is one of kinematics: the rate of its state is a variable, or a sum or
/// difference of other variables, with no number in front.
bool is_kinematic(const Scope& scope, Index equation) {
  const Equation& terms = terms_of(scope.model, equation);
  return !terms.empty() &&
         std::all_of(terms.begin(), terms.end(), [&](const WeightedTerm& one) {
           const Expression& x = one.term.expression();
           return is_variable(x) && std::abs(one.coefficient) == 1.0 &&
                  !(x == own_state(scope, equation));
         });
}

/// Whether a variable is a position (its own equation is one of kinematics) or a velocity (it
/// stands in one).
struct Kinematics {
  bool position = false;
  bool velocity = false;
};

Kinematics kinematics_of(const Scope& scope, const Expression& x) {
  Kinematics result;
  for (Index k = 0; k < scope.model.dimension(); ++k) {
    if (!is_kinematic(scope, k)) continue;
    result.position |= x == own_state(scope, k);
    for (const WeightedTerm& one : terms_of(scope.model, k))
      result.velocity |= one.term.expression() == x;
  }
  return result;
}

/// Whether one of two variables is known as a position and the other as a velocity.
bool are_of_two_kinds(const Scope& scope, const Expression& x, const Expression& y) {
  const Kinematics a = kinematics_of(scope, x), b = kinematics_of(scope, y);
  return (a.position && b.velocity) || (a.velocity && b.position);
}

/// Whether nothing converts the unit of one variable to that of the other: a speed less a
/// current is nothing.
bool are_in_other_units(const Scope& scope, const Expression& x, const Expression& y) {
  return do_not_convert(scope.range_of(x).unit, scope.range_of(y).unit);
}

/// Whether two terms of an equation have a difference in them: variables with opposite
/// coefficients, or states of one kind and unit with coefficients of opposite sign. -a*x + b*y
/// is min(a,b)*(y-x) and the rest of the larger one, as of a body that is held by another one
/// and by the ground.
bool have_a_difference(const Scope& scope, const WeightedTerm& one, const WeightedTerm& other) {
  const Expression &x = one.term.expression(), &y = other.term.expression();
  if (are_opposite(one, other)) return true;
  return is_variable(x) && is_variable(y) && !are_in_other_units(scope, x, y) &&
         !is_input(scope, x) && !is_input(scope, y) &&
         one.coefficient * other.coefficient < 0.0 && !are_of_two_kinds(scope, x, y);
}

}  // namespace

std::vector<Expression> differences(const Scope& scope, Index equation) {
  std::vector<Expression> result;
  const auto add = [&](const Expression& a, const Expression& b) {
    const bool own_last = b == own_state(scope, equation);
    result.push_back(own_last ? b - a : a - b);
  };
  const Equation& terms = terms_of(scope.model, equation);
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Expression& term = terms[i].term.expression();
    if (is_difference(term)) add(term.operands()[0], term.operands()[1]);
    for (std::size_t j = i + 1; j < terms.size(); ++j)
      if (have_a_difference(scope, terms[i], terms[j])) add(term, terms[j].term.expression());
  }
  return result;
}

std::vector<Expression> felt_speeds(const Scope& scope, Index equation) {
  std::vector<Expression> speeds{own_state(scope, equation)};
  for (const Expression& slip : differences(scope, equation))
    if (is_own_speed(scope, equation, slip)) speeds.push_back(slip);
  for (Index k = 0; k < scope.model.dimension(); ++k)
    if (k != equation && is_velocity(scope, equation) && is_velocity(scope, k))
      speeds.push_back(own_state(scope, k));
  return speeds;
}

bool is_felt_speed(const Scope& scope, Index equation, const Expression& speed) {
  const std::vector<Expression> speeds = felt_speeds(scope, equation);
  return std::find(speeds.begin(), speeds.end(), speed) != speeds.end();
}

bool is_own_speed(const Scope& scope, Index equation, const Expression& speed) {
  const Expression& first = is_difference(speed) ? speed.operands()[0] : speed;
  return first == own_state(scope, equation);
}

std::vector<Expression> linear_arguments(const Scope& scope, Index equation) {
  std::vector<Expression> result;
  for (const WeightedTerm& summand : terms_of(scope.model, equation))
    if (is_variable(summand.term.expression())) result.push_back(summand.term.expression());
  for (const Expression& difference : differences(scope, equation))
    result.push_back(difference);
  return result;
}

bool is_transmission(const Scope& scope, const Expression& argument) {
  if (is_difference(argument)) return true;
  for (Index j = 0; j < scope.model.dimension(); ++j) {
    if (own_state(scope, j) != argument) continue;
    const Equation& rate = terms_of(scope.model, j);
    return (rate.size() == 1 && is_difference(rate[0].term.expression())) ||
           (rate.size() == 2 && are_opposite(rate[0], rate[1]));
  }
  return false;
}

std::vector<Expression> nonlinear_terms(const Scope& scope, Index equation) {
  std::vector<Expression> result;
  for (const WeightedTerm& summand : terms_of(scope.model, equation)) {
    const Expression& term = summand.term.expression();
    if (!is_variable(term) && varies(term)) result.push_back(term);
  }
  return result;
}

std::vector<TermFactor> factors_of(const Expression& term) {
  std::vector<TermFactor> result;
  collect_factors(term, {}, result);
  std::erase_if(result, [](const TermFactor& factor) { return !varies(factor.rest); });
  return result;
}

std::optional<Expression> common_factor(const Scope& scope, Index equation) {
  const Equation& terms = terms_of(scope.model, equation);
  if (terms.size() < 2) return std::nullopt;
  std::vector<Expression> common = operands_of(terms.front().term.expression());
  for (const WeightedTerm& summand : terms) {
    std::vector<Expression> left = operands_of(summand.term.expression());
    std::erase_if(common, [&](const Expression& factor) {
      const auto place = std::find(left.begin(), left.end(), factor);
      if (place == left.end()) return true;
      left.erase(place);
      return false;
    });
  }
  std::erase_if(common, [](const Expression& factor) {
    return !varies(factor) || is_variable(factor) || is_whole_power(factor);
  });
  if (common.empty()) return std::nullopt;
  return product_of(common);
}

Expression right_hand_side(const Scope& scope, Index equation) {
  std::optional<Expression> sum;
  for (const WeightedTerm& summand : terms_of(scope.model, equation)) {
    const Expression part = Expression::number(summand.coefficient) * summand.term.expression();
    sum = sum ? *sum + part : part;
  }
  return sum.value_or(Expression());
}

double magnitude_quantile(const Scope& scope, const Expression& argument, double level) {
  return scope.range_of(Expression::make(Operation::Abs, {argument})).quantile(level);
}

}  // namespace lacuna
