// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// Slower than this share of the largest speed is where friction may rise.
constexpr double kSlowest = 0.005, kFastest = 0.5;

std::vector<Candidate> make(const Scope& scope, Index equation) {
  const VariableRange& v = scope.state(equation);
  if (!v.changes_sign()) return {};
  const double widest = v.magnitude();
  Candidate candidate =
      plain_candidate("(1+$rise*exp(-(" + v.name + "/$speed)^2))*sign(" + v.name + ")", v.name,
                      "dry friction opposing " + v.name + " that is larger at low speed");
  candidate.shapes = {{"rise", "", 0.05, 10.0, true},
                      {"speed", v.unit, kSlowest * widest, kFastest * widest, true}};
  for (const double speed : {0.02 * widest, 0.08 * widest, 0.25 * widest})
    candidate.starts.push_back(Vector{{1.0, speed}});
  return {candidate};
}

}  // namespace

const EffectFamily kStribeckFriction{
    {"stribeck-friction", "Dry friction that is larger near standstill",
     "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994)"},
    "boundary lubrication, stick-slip",
    "coulomb-friction",
    make,
    opposes};

}  // namespace lacuna
