// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

void add_friction(const std::string& v, const VariableRange& range,
                  std::vector<Candidate>& result) {
  const std::string description = "dry friction opposing " + v;
  result.push_back(plain_candidate("sign(" + v + ")", v, description));
  // From where it cannot be told from a jump to where it cannot be told from a straight line.
  const double widest = range.magnitude();
  result.push_back(shaped_candidate("tanh((" + v + ")/$width)", v, description,
                                    {"width", range.unit, 1e-4 * widest, widest, true},
                                    starts_at({0.01 * widest, 0.1 * widest})));
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  const VariableRange& own = scope.state(equation);
  if (own.changes_sign()) add_friction(own.name, own, result);
  for (const std::string& slip : differences(scope, equation))
    if (slip.substr(0, slip.find('-')) == own.name)
      add_friction(slip, scope.range_of(slip), result);
  return result;
}

}  // namespace

const EffectFamily kCoulombFriction{
    {"coulomb-friction", "Dry friction: a constant force against the velocity",
     "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994)"},
    "bearings, seals, guides, brushes",
    {},
    make,
    opposes};

}  // namespace lacuna
