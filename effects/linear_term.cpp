// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> linear_term_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope))
    if (!has_term(scope, equation, x)) result.push_back(plain_candidate(x, x));
  if (const auto factor = common_factor(scope, equation))
    for (const Expression& x : all_variables(scope))
      if (!factor->variables().contains(x.name()) && !has_term(scope, equation, *factor * x))
        result.push_back(plain_candidate(*factor * x, x));
  return result;
}

std::optional<Reading> linear_term_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const Expression& x = candidate.argument;
  if (!is_variable(x) || x.name() == "t" || !candidate.memory.empty()) return std::nullopt;
  if (candidate.form == x) return Reading{"linear term in " + x.name()};
  const auto factor = common_factor(fitted.scope, candidate.equation);
  if (!factor || candidate.form != *factor * x) return std::nullopt;
  return Reading{"linear term in " + x.name() + ", with the " + factor->to_string() +
                 " that all terms have"};
}

}  // namespace

const EffectFamily kLinearTerm{
    {"linear-term", "A term proportional to a state or an input", ""},
    "a forgotten resistor, damper, spring or path",
    linear_term_forms,
    linear_term_reading};

}  // namespace lacuna
