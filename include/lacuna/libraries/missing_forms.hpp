// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/candidates/candidate.hpp"
#include "lacuna/core/run_context.hpp"
#include "lacuna/data/dataset.hpp"
#include "lacuna/model/term.hpp"

namespace lacuna {

/// A form that a library lacks in one equation, with numbers for its shapes.
struct MissingForm {
  Candidate candidate;
  Vector shapes;

  Expression expression() const;
};

/// What is searched in.
struct FormSearch {
  const Dataset& data;
  const TermLibrary& library;  ///< terms that are there already
  const Vector& noise;         ///< of each state, state units
  int most_forms = 3;          ///< in one equation
};

/// Forward search in the weak form, whose rows are white for white noise: of all candidates of
/// an equation the one is taken in that leaves least beside the library, its shapes fitted by
/// variable projection (coefficients are eliminated by least squares for each value of the
/// shapes); what was taken in before is fitted again. It ends where only noise is left or where
/// no form takes away a tenth of the residual.
/// Source: Golub & Pereyra, SIAM J. Numer. Anal. 10 (1973) 413.
std::vector<MissingForm> missing_forms(const FormSearch& search,
                                       const std::vector<Candidate>& candidates,
                                       const RunContext& context = {});

/// Adds a form beside which so many terms of an equation may leave that the whole has fewer
/// coefficients and shapes than before, and leaves the same to a tenth: sin(x) for x, x^3,
/// x*y^2.
/// @param terms of the equation, without the forms. @return whether there is one.
bool replace_terms(const Dataset& data, const std::vector<Term>& terms,
                   const std::vector<Candidate>& candidates, std::vector<MissingForm>& forms,
                   const RunContext& context = {});

/// The shapes of forms fitted beside fixed terms of their equation.
/// @param terms of the equation, without the forms.
void refit_shapes(const Dataset& data, const std::vector<Term>& terms,
                  std::vector<MissingForm>& forms, const RunContext& context = {});

}  // namespace lacuna
