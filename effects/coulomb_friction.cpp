// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

void add_friction(const VariableRange& range, const std::string& relation,
                  std::vector<Candidate>& result) {
  const std::string& v = range.name;
  const std::string description = "dry friction " + relation + v;
  result.push_back(plain_candidate("sign(" + v + ")", v, description));
  // From where it cannot be told from a jump to where it cannot be told from a straight line.
  const double widest = range.magnitude();
  result.push_back(shaped_candidate("tanh((" + v + ")/$width)", v, description,
                                    {"width", range.unit, 1e-4 * widest, widest, true},
                                    starts_at({0.01 * widest, 0.1 * widest})));
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& v : felt_speeds(scope, equation))
    if (const VariableRange speed = range_of(scope, v); speed.changes_sign())
      add_friction(speed, is_own_speed(scope, equation, v) ? "opposing " : "of ", result);
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
