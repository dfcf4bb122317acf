// SPDX-License-Identifier: MIT
// The functions of the formula language (Expression), for formulas that are written in C++:
// 2 * sin(x) - pow(y, 3).
#pragma once

#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// Sine of an angle in rad.
Expression sin(const Expression& x);

/// Cosine of an angle in rad.
Expression cos(const Expression& x);

/// Tangent of an angle in rad.
Expression tan(const Expression& x);

/// Inverse sine, rad.
Expression asin(const Expression& x);

/// Inverse cosine, rad.
Expression acos(const Expression& x);

/// Inverse tangent, rad.
Expression atan(const Expression& x);

/// Hyperbolic tangent.
Expression tanh(const Expression& x);

/// Exponential function.
Expression exp(const Expression& x);

/// Natural logarithm.
Expression log(const Expression& x);

/// Square root.
Expression sqrt(const Expression& x);

/// Absolute value |x|.
Expression abs(const Expression& x);

/// -1, 0 or 1.
Expression sign(const Expression& x);

/// 0 for x < 0, 1 from 0 on.
Expression step(const Expression& x);

/// base^exponent.
Expression pow(const Expression& base, const Expression& exponent);

/// The smaller of two.
Expression min(const Expression& a, const Expression& b);

/// The larger of two.
Expression max(const Expression& a, const Expression& b);

/// x, but no less than `low` and no more than `high`.
Expression clip(const Expression& x, const Expression& low, const Expression& high);

}  // namespace lacuna
