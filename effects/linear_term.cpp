// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/forms.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> linear_term_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope))
    if (!has_term(scope, equation, x)) result.push_back(plain_candidate(x, x));
  return result;
}

std::optional<Reading> linear_term_reading(const FittedForm& fitted) {
  const Expression& x = fitted.candidate.form;
  if (!is_variable(x) || x.name() == "t" || !fitted.candidate.memory.empty())
    return std::nullopt;
  return Reading{"linear term in " + x.name()};
}

}  // namespace

const EffectFamily kLinearTerm{
    {"linear-term", "A term proportional to a state or an input", ""},
    "a forgotten resistor, damper, spring or path",
    linear_term_forms,
    linear_term_reading};

}  // namespace lacuna
