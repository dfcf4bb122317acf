// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "form_rows.hpp"
#include "identify/forms_beside/missing_forms.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {

/// Products of a monomial and a function of one variable that saturates or is inhibited,
///   m / (1 + x^n/a^n),   m x^n / (a^n + x^n),   n = 1..4 for amounts, else 2 and 4,
/// m being 1, a state or an input, or a product of two of them. The argument is x.
std::vector<Candidate> product_forms(const Scope& scope);

/// Compositions that are sought where all simpler forms leave something: with m a monomial up
/// to degree 2 (of more than three variables: 1) and x a variable,
///   m exp(x/a), m exp(-x/a), m sin(x/a), m cos(x/a), m sin(x), m cos(x);
///   m/x, m/x^2, m/x^3 and m x^p of positive x that is no factor of m;
///   sin(d), cos(d), |d|, d |d|, x |d|, y |d| of differences d = x - y.
std::vector<Candidate> composed_forms(const Scope& scope, Index equation);

/// Forcing from outside: m sin(2 pi f t + p) with m = 1 or a variable. Frequencies are the peaks
/// of the least-squares spectrum of what the terms of an equation leave, terms and tone fitted
/// together (Vanicek, Astrophys. Space Sci. 12 (1971) 10; with other terms beside the tone:
/// Zechmeister & Kurster, Astron. Astrophys. 496 (2009) 577).
/// @param equation with the terms that stay beside a tone. @param count of peaks for each m.
std::vector<Candidate> forcing_forms(const Scope& scope, const FormRows& rows,
                                     const EquationForms& equation, std::size_t count,
                                     const RunContext& context);

/// Monomials up to a degree in states and inputs, the constant first, as formulas: "x^2*y".
std::vector<Expression> monomials_of(const Scope& scope, int degree);

}  // namespace lacuna
