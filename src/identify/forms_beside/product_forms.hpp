// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/forms/candidate/candidate.hpp"
#include "lacuna/forms/candidate/scope.hpp"

namespace lacuna {

/// Products of a monomial and a function of one variable that saturates or is inhibited,
///   m / (1 + x^n/a^n),   m x^n / (a^n + x^n),   n = 1..4 for amounts, else 2 and 4,
/// m being 1, a state or an input, or a product of two of them. The argument is x.
std::vector<Candidate> product_forms(const Scope& scope);

/// Monomials up to a degree in states and inputs, the constant first, as formulas: "x^2*y".
std::vector<Expression> monomials_of(const Scope& scope, int degree);

}  // namespace lacuna
