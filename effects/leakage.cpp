// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> leakage_forms(const Scope& scope, Index equation) {
  const Expression x = own_state(scope, equation);
  std::vector<Candidate> result;
  const Expression root = formula(scope, "sqrt(x)", {{"x", x}});
  if (scope.state(equation).is_amount() && !has_term(scope, equation, root))
    result.push_back(plain_candidate(formula(scope, "sqrt(max(x,0))", {{"x", x}}), x));
  if (!has_term(scope, equation, x) && !is_velocity(scope, equation))
    result.push_back(plain_candidate(x, x));
  return result;
}

// What is lost is lost from the state itself; in proportion to it, it is as well a linear term.
std::optional<Reading> leakage_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const Expression own = own_state(fitted.scope, candidate.equation);
  if (candidate.argument != own || fitted.coefficient >= 0.0) return std::nullopt;
  if (has_form(candidate, "sqrt(max(x,0))"))
    return Reading{"outflow of " + own.name() + " by a hole"};
  if (candidate.form == own && !is_velocity(fitted.scope, candidate.equation))
    return Reading{"leakage of " + own.name(), Precedence::Special};
  return std::nullopt;
}

}  // namespace

const EffectFamily kLeakage{{"leakage", "What is stored gets lost by itself",
                             "Torricelli's law for the outflow of a tank"},
                            "a leaky capacitor, a hole, a seal, heat loss",
                            leakage_forms,
                            leakage_reading};

}  // namespace lacuna
