// SPDX-License-Identifier: MIT
#include <algorithm>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// Factors of the equation's products.
std::vector<Expression> factors(const Scope& scope, Index equation) {
  std::vector<Expression> result;
  for (const Expression& term : nonlinear_terms(scope, equation))
    for (const std::string& x : term.variables())
      if (x != "t") result.push_back(Expression::variable(x));
  return result;
}

bool is_factor(const Scope& scope, Index equation, const Expression& x) {
  const std::vector<Expression> all = factors(scope, equation);
  return std::find(all.begin(), all.end(), x) != all.end();
}

std::vector<Candidate> feedthrough_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope))
    if (!has_term(scope, equation, x) && (is_input(scope, x) || is_factor(scope, equation, x)))
      result.push_back(plain_candidate(x, x));
  return result;
}

// That of an input is a path of its own; a factor by itself is as well a linear term.
std::optional<Reading> feedthrough_reading(const FittedForm& fitted) {
  const Expression& x = fitted.candidate.form;
  if (is_input(fitted.scope, x))
    return Reading{"direct path from the input " + x.name(), Precedence::Contextual};
  if (is_variable(x) && is_factor(fitted.scope, fitted.candidate.equation, x))
    return Reading{"feedthrough of the factor " + x.name(), Precedence::Special};
  return std::nullopt;
}

}  // namespace

const EffectFamily kFeedthrough{
    {"feedthrough", "An input or a factor of a product leaks into the equation by itself", ""},
    "a multiplier's feedthrough, stray capacitance, crosstalk",
    feedthrough_forms,
    feedthrough_reading};

}  // namespace lacuna
