// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// Slower than this share of the largest speed is where friction may rise.
constexpr double kSlowest = 0.005, kFastest = 0.5;

// How wide the reversal may be: from where it cannot be told from a jump to where it hides the
// rise.
constexpr double kSharpest = 1e-4, kBluntest = 0.1;

std::string friction_by(const std::string& v, const std::string& direction) {
  return "(1+$rise*exp(-(" + v + "/$speed)^2))*" + direction;
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  const VariableRange& v = scope.state(equation);
  if (!v.changes_sign()) return {};
  const double widest = v.magnitude();
  const std::string description =
      "dry friction opposing " + v.name + " that is larger at low speed";
  Candidate sharp =
      plain_candidate(friction_by(v.name, "sign(" + v.name + ")"), v.name, description);
  sharp.shapes = {{"rise", "", 0.05, 10.0, true},
                  {"speed", v.unit, kSlowest * widest, kFastest * widest, true}};
  Candidate blunt =
      plain_candidate(friction_by(v.name, "tanh(" + v.name + "/$width)"), v.name, description);
  blunt.shapes = sharp.shapes;
  blunt.shapes.push_back({"width", v.unit, kSharpest * widest, kBluntest * widest, true});
  for (const double speed : {0.02 * widest, 0.08 * widest, 0.25 * widest}) {
    sharp.starts.push_back(Vector{{1.0, speed}});
    blunt.starts.push_back(Vector{{1.0, speed, 0.01 * widest}});
  }
  return {sharp, blunt};
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
