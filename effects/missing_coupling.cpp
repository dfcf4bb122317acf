// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// An exchange between two states of one kind that the equation has no linear term of. Where it
// has one of them the other alone says the same.
bool may_exchange(const Scope& scope, Index equation, const VariableRange& other) {
  const VariableRange& own = scope.state(equation);
  return own.unit == other.unit && own.name != other.name &&
         !has_term(scope, equation, own.name) && !has_term(scope, equation, other.name);
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (Index j = 0; j < scope.model.dimension(); ++j) {
    const std::string& x = scope.state(j).name;
    if (in_other_part(scope, equation, x))
      result.push_back(plain_candidate(x, x, "coupling to " + x));
    if (may_exchange(scope, equation, scope.state(j))) {
      const std::string difference = x + "-" + scope.state(equation).name;
      result.push_back(plain_candidate(difference, difference, "exchange with " + x));
    }
  }
  return result;
}

// An exchange goes from the larger to the smaller.
bool plausible(const Scope& scope, const Candidate& candidate, const FittedCandidate& fitted) {
  const bool exchange =
      candidate.argument.ends_with("-" + scope.state(candidate.equation).name);
  return !exchange || fitted.coefficient > 0.0;
}

}  // namespace

const EffectFamily kMissingCoupling{
    {"missing-coupling", "A path between parts that the nominal model keeps apart", ""},
    "a common supply, a common base, stray coupling",
    {},
    make,
    plausible};

}  // namespace lacuna
