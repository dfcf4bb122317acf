// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// An exchange between two states that the equation has no linear term of. Where it has one of
// them the other alone is equivalent.
bool may_exchange(const Scope& scope, Index equation, Index other) {
  return other != equation && !has_term(scope, equation, own_state(scope, equation)) &&
         !has_term(scope, equation, own_state(scope, other));
}

std::vector<Candidate> missing_coupling_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (Index j = 0; j < scope.model.dimension(); ++j) {
    const Expression x = own_state(scope, j);
    if (in_other_part(scope, equation, x)) result.push_back(plain_candidate(x, x));
    if (!may_exchange(scope, equation, j)) continue;
    const Expression difference = x - own_state(scope, equation);
    result.push_back(plain_candidate(difference, difference));
  }
  return result;
}

// An exchange goes from the larger to the smaller.
std::optional<Reading> missing_coupling_reading(const FittedForm& fitted) {
  const Expression& form = fitted.candidate.form;
  const Index equation = fitted.candidate.equation;
  if (!fitted.candidate.memory.empty()) return std::nullopt;  // a state of an effect is no part
  if (is_variable(form) && in_other_part(fitted.scope, equation, form))
    return Reading{"coupling to " + form.name(), Precedence::Contextual};
  if (!is_difference(form) || form.operands()[1] != own_state(fitted.scope, equation) ||
      fitted.coefficient <= 0.0)
    return std::nullopt;
  return Reading{"exchange with " + form.operands()[0].name()};
}

}  // namespace

const EffectFamily kMissingCoupling{
    {"missing-coupling", "A path between parts that the nominal model keeps apart", ""},
    "a common supply, a common base, stray coupling",
    missing_coupling_forms,
    missing_coupling_reading};

}  // namespace lacuna
