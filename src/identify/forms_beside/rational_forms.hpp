// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "form_rows.hpp"
#include "identify/forms_beside/missing_forms.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {

/// Fractions m / Q with a denominator in several variables, for one equation: Q = 1 + a u + b v,
/// 1 + a u or u + a v, or 1 + a u + b v + c w where that is better by more than the number costs,
/// with monomials u, v, w that are not negative in the records.
///
/// Denominators are found in the implicit form, which is linear in all numbers: with w = dx/dt,
///   w u_0 = sum_i p_i theta_i - sum_j q_j w u_j,
/// each u_0 in its turn on the left-hand side (SINDy-PI: Kaheman, Kutz & Brunton, Proc. R. Soc.
/// A 476 (2020) 20200279), in rows of the weak form. Noise in w biases q: these numbers are
/// only where the fit of a form begins. The denominators beside which the fewest terms theta/Q
/// leave least are taken, with each monomial m up to degree 2.
/// @param equation with the terms theta. @param denominators that are taken at most.
std::vector<Candidate> rational_forms(const Scope& scope, const FormRows& rows,
                                      const EquationForms& equation, std::size_t denominators,
                                      const RunContext& context);

}  // namespace lacuna
