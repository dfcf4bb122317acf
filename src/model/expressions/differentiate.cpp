// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/expressions/expression.hpp"
#include "operations.hpp"

namespace lacuna {
namespace {

Expression number(double value) { return Expression::number(value); }

/// The operation, evaluated when its operands are numbers and its value is finite.
Expression folded(Operation operation, std::vector<Expression> operands) {
  Expression made = Expression::make(operation, std::move(operands));
  for (const Expression& operand : made.operands())
    if (!is_number(operand)) return made;
  const std::optional<double> value = constant_value(made);
  return value && std::isfinite(*value) ? number(*value) : made;
}

Expression plus(const Expression& a, const Expression& b) {
  if (is_number(a, 0.0)) return b;
  if (is_number(b, 0.0)) return a;
  return folded(Operation::Add, {a, b});
}

Expression negated(const Expression& a) {
  if (is_number(a, 0.0)) return a;
  return a.operation() == Operation::Negate ? a.operands()[0] : -a;
}

Expression minus(const Expression& a, const Expression& b) {
  if (is_number(b, 0.0)) return a;
  if (is_number(a, 0.0)) return negated(b);
  return folded(Operation::Subtract, {a, b});
}

Expression times(const Expression& a, const Expression& b) {
  if (is_number(a, 0.0) || is_number(b, 0.0)) return number(0.0);
  if (is_number(a, 1.0)) return b;
  if (is_number(b, 1.0)) return a;
  if (is_number(a, -1.0)) return negated(b);
  return folded(Operation::Multiply, {a, b});
}

Expression over(const Expression& a, const Expression& b) {
  if (is_number(a, 0.0) || is_number(b, 1.0)) return a;
  return folded(Operation::Divide, {a, b});
}

Expression power(const Expression& a, const Expression& b) {
  if (is_number(b, 0.0)) return number(1.0);
  if (is_number(b, 1.0)) return a;
  return folded(Operation::Power, {a, b});
}

Expression call(Operation operation, const Expression& a) { return folded(operation, {a}); }

Expression square(const Expression& a) { return power(a, number(2.0)); }

/// d/dx of e, with x fixed at construction.
class Derivative {
 public:
  explicit Derivative(std::string_view variable) : variable_(variable) {}

  Expression of(const Expression& e) const {
    if (e.operation() == Operation::Delay) return of_delay(e);
    const auto operands = e.operands();
    switch (operands.size()) {
      case 0:
        return leaf(e);
      case 1:
        return times(outer(e, operands[0]), of(operands[0]));
      case 2:
        return of_two(e, operands[0], operands[1]);
      default:
        return of(unfolded_clip(operands));
    }
  }

 private:
  Expression leaf(const Expression& e) const {
    const bool same = e.operation() == Operation::Variable && e.name() == variable_;
    return number(same ? 1.0 : 0.0);
  }

  Expression of_delay(const Expression& e) const {
    if (!e.operands().empty() && e.operands()[0].variables().contains(std::string(variable_)))
      throw ModelError("derivative of " + e.to_string(),
                       "the delay depends on '" + std::string(variable_) + "'",
                       "bind it to a number first");
    return number(0.0);
  }

  Expression of_one(const Expression& e, const Expression& u) const {
    const Expression du = of(u);
    if (e.operation() == Operation::Negate) return negated(du);
    return is_number(du, 0.0) ? du : times(outer(e, u), du);
  }

  /// f'(u) of a function of one argument e = f(u).
  static Expression outer(const Expression& e, const Expression& u) {
    const Expression one = number(1.0);
    switch (e.operation()) {
      case Operation::Negate:
        return number(-1.0);
      case Operation::Sin:
        return call(Operation::Cos, u);
      case Operation::Cos:
        return negated(call(Operation::Sin, u));
      case Operation::Tan:
        return plus(one, square(e));
      case Operation::Asin:
        return over(one, call(Operation::Sqrt, minus(one, square(u))));
      case Operation::Acos:
        return over(number(-1.0), call(Operation::Sqrt, minus(one, square(u))));
      case Operation::Atan:
        return over(one, plus(one, square(u)));
      case Operation::Tanh:
        return minus(one, square(e));
      case Operation::Exp:
        return e;
      case Operation::Log:
        return over(one, u);
      case Operation::Sqrt:
        return over(number(0.5), e);
      case Operation::Abs:
        return call(Operation::Sign, u);
      default:
        return number(0.0);  // sign and step are flat almost everywhere
    }
  }

  Expression of_two(const Expression& e, const Expression& a, const Expression& b) const {
    switch (e.operation()) {
      case Operation::Add:
        return plus(of(a), of(b));
      case Operation::Subtract:
        return minus(of(a), of(b));
      case Operation::Multiply:
        return plus(times(of(a), b), times(a, of(b)));
      case Operation::Divide:
        return of_quotient(a, b);
      case Operation::Power:
        return of_power(e, a, b);
      case Operation::Min:
        return selected(minus(b, a), of(a), of(b));
      default:
        return selected(minus(a, b), of(a), of(b));
    }
  }

  Expression of_quotient(const Expression& a, const Expression& b) const {
    const Expression db = of(b);
    if (is_number(db, 0.0)) return over(of(a), b);
    return over(minus(times(of(a), b), times(a, db)), square(b));
  }

  /// (a^b)' = b a^(b-1) a' + a^b log(a) b'.
  Expression of_power(const Expression& e, const Expression& a, const Expression& b) const {
    const Expression da = of(a);
    const Expression db = of(b);
    const Expression lowered = power(a, minus(b, number(1.0)));
    const Expression by_base = is_number(da, 0.0) ? da : times(times(b, lowered), da);
    if (is_number(db, 0.0)) return by_base;
    return plus(by_base, times(times(e, call(Operation::Log, a)), db));
  }

  /// `first` where selector >= 0, else `second`.
  static Expression selected(const Expression& selector, const Expression& first,
                             const Expression& second) {
    if (first == second) return first;
    const Expression choice = call(Operation::Step, selector);
    return plus(times(choice, first), times(minus(number(1.0), choice), second));
  }

  static Expression unfolded_clip(std::span<const Expression> operands) {
    const Expression raised = Expression::make(Operation::Max, {operands[0], operands[1]});
    return Expression::make(Operation::Min, {raised, operands[2]});
  }

  std::string_view variable_;
};

}  // namespace

Expression differentiate(const Expression& expression, std::string_view variable) {
  return Derivative(variable).of(expression);
}

}  // namespace lacuna
