// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  const auto position = scope.integral_of(equation);
  std::vector<Candidate> result;
  if (position && !has_term(scope, equation, scope.state(*position).name + "^3")) {
    const std::string& x = scope.state(*position).name;
    result.push_back(plain_candidate(x + "^3", x, "cubic stiffness in " + x));
  }
  for (const std::string& twist : differences(scope, equation))
    result.push_back(
        plain_candidate("(" + twist + ")^3", twist, "cubic stiffness in " + twist));
  return result;
}

}  // namespace

const EffectFamily kCubicStiffness{
    {"cubic-stiffness", "A spring that hardens or softens with the cube of its stretch",
     "Duffing 1918"},
    "a clamped beam, a rubber mount, a saturating core",
    {},
    make};

}  // namespace lacuna
