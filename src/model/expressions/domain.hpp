// SPDX-License-Identifier: MIT
// Functions that are not defined everywhere: sqrt, log, asin, acos, powers that are not whole.
#pragma once

#include <vector>

#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// The formula with the arguments of these functions moved into their domain: the smallest
/// positive number in the place of what is below it, 1 less rounding in the place of what is
/// beyond. Inside it is the same formula. Outside it goes on as it is at the edge, where roots
/// have a value and an infinite slope; derivatives (differentiate()) are finite everywhere, 0
/// outside.
Expression held_in_domain(const Expression& expression);

/// Formulas that are below 0 where some function of this one is not defined: x of sqrt(x).
std::vector<Expression> domain_margins(const Expression& expression);

}  // namespace lacuna
