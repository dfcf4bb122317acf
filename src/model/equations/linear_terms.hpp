// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The sum of formulas as a sum of numbers times terms: "-9.81/0.5*sin(th)" is -19.62 times
/// sin(th). Products are multiplied out over sums, so that every number in front of something
/// becomes a coefficient: x*(28-z) is 28 x - x*z. Powers, divisors and the arguments of
/// functions stay as they are, and so do sums to the power of 1: 520*(m-w)^1 is 520 times m-w.
/// Terms that are there twice are joined; those that cancel are left out.
/// @throws ModelError for an unknown name, a coefficient that is not finite, or a product that
///   has more than 1000 terms when it is multiplied out.
Equation linear_terms(std::span<const Expression> summands, const VariableIndex& variables);

/// A term so written that linear_terms() gives it back: sums in it to the power of 1.
Expression kept_together(const Expression& term);

}  // namespace lacuna
