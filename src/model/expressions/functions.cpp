// SPDX-License-Identifier: MIT
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

Expression sin(const Expression& x) { return Expression::make(Operation::Sin, {x}); }
Expression cos(const Expression& x) { return Expression::make(Operation::Cos, {x}); }
Expression tan(const Expression& x) { return Expression::make(Operation::Tan, {x}); }
Expression asin(const Expression& x) { return Expression::make(Operation::Asin, {x}); }
Expression acos(const Expression& x) { return Expression::make(Operation::Acos, {x}); }
Expression atan(const Expression& x) { return Expression::make(Operation::Atan, {x}); }
Expression tanh(const Expression& x) { return Expression::make(Operation::Tanh, {x}); }
Expression exp(const Expression& x) { return Expression::make(Operation::Exp, {x}); }
Expression log(const Expression& x) { return Expression::make(Operation::Log, {x}); }
Expression sqrt(const Expression& x) { return Expression::make(Operation::Sqrt, {x}); }
Expression abs(const Expression& x) { return Expression::make(Operation::Abs, {x}); }
Expression sign(const Expression& x) { return Expression::make(Operation::Sign, {x}); }
Expression step(const Expression& x) { return Expression::make(Operation::Step, {x}); }

Expression pow(const Expression& base, const Expression& exponent) {
  return Expression::make(Operation::Power, {base, exponent});
}

Expression min(const Expression& a, const Expression& b) {
  return Expression::make(Operation::Min, {a, b});
}

Expression max(const Expression& a, const Expression& b) {
  return Expression::make(Operation::Max, {a, b});
}

Expression clip(const Expression& x, const Expression& low, const Expression& high) {
  return Expression::make(Operation::Clip, {x, low, high});
}

}  // namespace lacuna
