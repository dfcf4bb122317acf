// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  const VariableRange& v = scope.state(equation);
  const std::string form = v.name + "*abs(" + v.name + ")";
  if (!v.changes_sign() || has_term(scope, equation, form)) return {};
  return {plain_candidate(form, v.name, "drag of the square of " + v.name)};
}

}  // namespace

const EffectFamily kQuadraticDrag{
    {"quadratic-drag", "Drag of the square of the speed, against the motion", ""},
    "air or water resistance, turbulent flow, an orifice",
    {},
    make,
    opposes};

}  // namespace lacuna
