// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// How wide the reversal may be: from where it cannot be distinguished from a jump to where it
// hides the rise.
constexpr double kNarrowestReversal = 1e-4, kWidestReversal = 0.1;

std::vector<Candidate> stribeck_friction_forms(const Scope& scope, Index equation) {
  const VariableRange& speed = scope.state(equation);
  if (!speed.changes_sign()) return {};
  const double widest = speed.magnitude();
  const Expression v = own_state(scope, equation);
  Candidate sharp =
      plain_candidate(formula(scope, "(1+rise*exp(-(v/speed)^2))*sign(v)", {{"v", v}}), v);
  sharp.shapes = {{"rise", "", 0.05, 10.0, true}, rise_shapes(scope, v).front()};
  Candidate blunt = plain_candidate(
      formula(scope, "(1+rise*exp(-(v/speed)^2))*tanh(v/width)", {{"v", v}}), v);
  blunt.shapes = sharp.shapes;
  blunt.shapes.push_back(
      {"width", speed.unit, kNarrowestReversal * widest, kWidestReversal * widest, true});
  // What comes on top of dry friction that the model has.
  Candidate rise =
      plain_candidate(formula(scope, "exp(-abs(v/speed)^exponent)*sign(v)", {{"v", v}}), v);
  rise.shapes = rise_shapes(scope, v);
  for (const double rises : {0.02 * widest, 0.08 * widest, 0.25 * widest}) {
    rise.starts.push_back(Vector{{rises, 2.0}});
    sharp.starts.push_back(Vector{{1.0, rises}});
    blunt.starts.push_back(Vector{{1.0, rises, 0.01 * widest}});
  }
  return {sharp, blunt, rise};
}

std::optional<Reading> stribeck_friction_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!has_form(candidate, "(1+a*exp(-(x/b)^2))*sign(x)") &&
      !has_form(candidate, "(1+a*exp(-(x/b)^2))*tanh(x/c)") &&
      !has_form(candidate, "exp(-abs(x/a)^b)*sign(x)"))
    return std::nullopt;
  if (!opposes(fitted)) return std::nullopt;
  return Reading{"dry friction opposing " + candidate.argument.to_string() +
                 " that is larger at low speed"};
}

}  // namespace

const EffectFamily kStribeckFriction{
    {"stribeck-friction", "Dry friction that is larger near standstill",
     "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994)"},
    "boundary lubrication, stick-slip",
    stribeck_friction_forms,
    stribeck_friction_reading};

}  // namespace lacuna
