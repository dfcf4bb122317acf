// SPDX-License-Identifier: MIT
#include <cmath>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

void add_friction(const Scope& scope, const Expression& v, std::vector<Candidate>& result) {
  const VariableRange speed = scope.range_of(v);
  if (!speed.changes_sign()) return;
  result.push_back(plain_candidate(formula(scope, "sign(v)", {{"v", v}}), v));
  // From where it cannot be distinguished from a jump to where it cannot be distinguished from
  // a straight line.
  const double widest = speed.magnitude();
  result.push_back(shaped_candidate(formula(scope, "tanh(v/width)", {{"v", v}}), v,
                                    {"width", speed.unit, 1e-4 * widest, widest, true, true},
                                    starts_at({0.01 * widest, 0.1 * widest})));
}

std::vector<Candidate> coulomb_friction_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& v : felt_speeds(scope, equation)) add_friction(scope, v, result);
  return result;
}

// A bend so near to standstill that it is as good as a jump: steep about standstill and against
// the motion there. The form has to be what acts there; one that takes it away outside empties
// the nominal term and is equivalent to it with other coefficients than were given.
bool bends_at_standstill(const FittedForm& fitted) {
  const std::optional<Bend> bend = bend_of(fitted);
  if (!bend || !has_form(fitted.candidate, "clip(x,-a,a)") ||
      std::abs(bend->inside) <= std::abs(bend->outside))
    return false;
  const bool own =
      is_own_speed(fitted.scope, fitted.candidate.equation, fitted.candidate.argument);
  return bend->edge < fitted.options.standstill * range_of_argument(fitted).magnitude() &&
         (!own || bend->inside < 0.0);
}

// Whether a form of friction is one: its force is there as soon as something moves.
bool is_there_at_once(const FittedForm& fitted) {
  const std::optional<Bend> bend = bend_of(fitted);
  return !bend || bend->edge < fitted.options.standstill * range_of_argument(fitted).magnitude();
}

std::optional<Reading> coulomb_friction_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const Expression& v = candidate.argument;
  if (!is_felt_speed(fitted.scope, candidate.equation, v)) return std::nullopt;
  const bool own_form = has_form(candidate, "sign(x)") || has_form(candidate, "tanh(x/a)");
  const bool rubs = own_form && opposes(fitted) && is_there_at_once(fitted);
  if (!rubs && !bends_at_standstill(fitted)) return std::nullopt;
  const bool own = is_own_speed(fitted.scope, candidate.equation, v);
  return Reading{(own ? "dry friction opposing " : "dry friction of ") + v.to_string(),
                 Precedence::Contextual,
                 std::vector<std::string>(candidate.shapes.size(), "width")};
}

}  // namespace

const EffectFamily kCoulombFriction{
    {"coulomb-friction", "Dry friction: a constant force against the velocity",
     "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994)"},
    "bearings, seals, guides, brushes",
    coulomb_friction_forms,
    coulomb_friction_reading};

}  // namespace lacuna
