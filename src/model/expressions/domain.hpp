// SPDX-License-Identifier: MIT
// Functions that are not defined everywhere: sqrt, log, asin, acos, powers that are not whole.
#pragma once

#include <vector>

#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// The formula with the arguments of these functions moved into their domain. Inside it is the
/// same formula, outside it goes on as it is at the edge; logarithms, which have no value there,
/// as at the smallest positive number.
Expression held_in_domain(const Expression& expression);

/// The formula whose derivatives (differentiate()) are those of held_in_domain(), and finite at
/// the edge, too, where those of roots are not: arguments are held a rounding inside of it.
Expression held_off_edges(const Expression& expression);

/// Formulas that are below 0 where some function of this one is not defined: x of sqrt(x).
std::vector<Expression> domain_margins(const Expression& expression);

}  // namespace lacuna
