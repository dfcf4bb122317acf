// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  std::vector<std::string> terms = nonlinear_terms(scope, equation);
  for (const std::string& x : variable_names(scope))
    if (has_term(scope, equation, x)) terms.push_back(x);
  for (const std::string& term : terms)
    result.push_back(
        plain_candidate("t*(" + term + ")", term, "slow drift of the coefficient of " + term));
  return result;
}

}  // namespace

const EffectFamily kParameterDrift{
    {"parameter-drift", "A coefficient that changes steadily with time", ""},
    "warming up, wear, a battery that runs down",
    {},
    make};

}  // namespace lacuna
