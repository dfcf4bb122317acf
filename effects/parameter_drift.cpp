// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

Candidate drifting(const Expression& term) {
  return plain_candidate(Expression::variable("t") * term, term);
}

std::vector<Candidate> parameter_drift_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  if (!determines_time(scope)) return result;
  for (const Expression& term : nonlinear_terms(scope, equation))
    result.push_back(drifting(term));
  for (const Expression& x : all_variables(scope))
    if (has_term(scope, equation, x)) result.push_back(drifting(x));
  return result;
}

std::optional<Reading> parameter_drift_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!has_form(candidate, "t*x") ||
      !has_term(fitted.scope, candidate.equation, candidate.argument))
    return std::nullopt;
  return Reading{"slow drift of the coefficient of " + candidate.argument.to_string()};
}

}  // namespace

const EffectFamily kParameterDrift{
    {"parameter-drift", "A coefficient that changes steadily with time", ""},
    "warming up, wear, a battery that runs down",
    parameter_drift_forms,
    parameter_drift_reading};

}  // namespace lacuna
