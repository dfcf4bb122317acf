// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <span>
#include <string>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The sum of formulas as a sum of numbers times terms: "-9.81/0.5*sin(th)" is -19.62 times
/// sin(th). Products are multiplied out over sums, so that every number in front of something
/// becomes a coefficient: x*(28-z) is 28 x - x*z. Powers, divisors and the arguments of
/// functions stay as they are, and so do sums to the power of 1: 520*(m-w)^1 is 520 times m-w.
/// A product with a parameter in it is one term, its sums as they are: -(T-Ta)/150 is -1/150
/// times T-Ta, for 1/150 is one number. A sum with nothing but a sign in front is its summands.
/// Terms that are there twice are joined; those that cancel are left out.
/// @param parameters names of numbers.
/// @returns terms that are `fixed` where no number is written in front of them: x, but not 1*x.
/// @throws ModelError for an unknown name, a coefficient that is not finite, or a product that
///   has more than 1000 terms when it is multiplied out.
Equation linear_terms(std::span<const Expression> summands, const VariableIndex& variables,
                      const std::set<std::string>& parameters = {});

/// A summand multiplied out: with numbers for parameters its sums are sums of numbers times
/// terms. A number in it is a coefficient that may change.
Equation multiplied_out(const WeightedTerm& summand, const VariableIndex& variables);

/// A summand so written that linear_terms() gives its term back: sums in it to the power of 1,
/// but for those that stay together as they are.
/// @param bare whether nothing but a sign is written in front of the term.
Expression kept_together(const Expression& term, const std::set<std::string>& parameters = {},
                         bool bare = true);

}  // namespace lacuna
