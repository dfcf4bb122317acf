// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> quadratic_drag_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& v : felt_speeds(scope, equation)) {
    const Expression form = formula(scope, "v*abs(v)", {{"v", v}});
    if (scope.range_of(v).changes_sign() && !has_term(scope, equation, form))
      result.push_back(plain_candidate(form, v));
  }
  return result;
}

std::optional<Reading> quadratic_drag_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const Expression& v = candidate.argument;
  if (!has_form(candidate, "x*abs(x)") || !opposes(fitted) ||
      !is_felt_speed(fitted.scope, candidate.equation, v))
    return std::nullopt;
  return Reading{"drag of the square of " + v.to_string()};
}

}  // namespace

const EffectFamily kQuadraticDrag{
    {"quadratic-drag", "Drag of the square of the speed, against the motion", ""},
    "air or water resistance, turbulent flow, an orifice",
    quadratic_drag_forms,
    quadratic_drag_reading};

}  // namespace lacuna
