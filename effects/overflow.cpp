// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

bool is_store(const Scope& scope, Index equation) {
  return !is_velocity(scope, equation) && scope.state(equation).is_amount();
}

std::vector<Candidate> overflow_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  if (!is_store(scope, equation)) return {};
  for (Index j = 0; j < scope.model.dimension(); ++j) {
    const VariableRange& level = scope.state(j);
    if (!level.is_amount()) continue;
    const Expression x = own_state(scope, j);
    const auto at = [&](double fraction) { return level.quantile(fraction); };
    result.push_back(
        shaped_candidate(formula(scope, "max(x-edge,0)", {{"x", x}}), x,
                         {"edge", level.unit, at(0.1), at(0.995), false},
                         starts_at({at(0.35), at(0.6), at(0.8), at(0.93), at(0.98)})));
  }
  return result;
}

// What runs over is lost where it was and gained elsewhere.
std::optional<Reading> overflow_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const Scope& scope = fitted.scope;
  const Expression& x = candidate.argument;
  if (!has_form(candidate, "max(x-a,0)") || !is_store(scope, candidate.equation) ||
      !is_variable(x) || is_input(scope, x) || !scope.range_of(x).is_amount())
    return std::nullopt;
  const bool own = x == own_state(scope, candidate.equation);
  if (own != (fitted.coefficient < 0.0)) return std::nullopt;
  return own ? Reading{x.name() + " runs over", Precedence::Contextual, {"edge"}}
             : Reading{"overflow of " + x.name() + " arrives", Precedence::Plain, {"edge"}};
}

}  // namespace

const EffectFamily kOverflow{{"overflow", "A store runs over beyond a level", ""},
                             "a weir, a spillway, a full tank, a bypass",
                             overflow_forms,
                             overflow_reading};

}  // namespace lacuna
