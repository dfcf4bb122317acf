// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  const auto position = scope.integral_of(equation);
  for (const std::string& x : variable_names(scope)) {
    if (has_term(scope, equation, x + "^3")) continue;
    result.push_back(plain_candidate(x + "^3", x, "cubic term in " + x));
    // The cube of a position in the equation of its velocity is a stiffness.
    if (position && scope.state(*position).name == x) result.back().plainer = "cubic-stiffness";
  }
  return result;
}

}  // namespace

const EffectFamily kCubicTerm{{"cubic-term", "A term in the cube of a state or an input", ""},
                              "a symmetric characteristic that bends, an odd distortion",
                              {},
                              make};

}  // namespace lacuna
