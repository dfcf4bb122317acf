// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> cubic_stiffness_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  const auto add = [&](const Expression& x) {
    const Expression cube = formula(scope, "x^3", {{"x", x}});
    if (!has_term(scope, equation, cube)) result.push_back(plain_candidate(cube, x));
  };
  if (const auto position = scope.integral_of(equation)) add(own_state(scope, *position));
  for (const Expression& twist : differences(scope, equation)) add(twist);
  return result;
}

// The cube of a position in the equation of its velocity, or of what lies between two places.
std::optional<Reading> cubic_stiffness_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const Expression& x = candidate.argument;
  const bool is_stretch = is_difference(x) || is_position(fitted.scope, candidate.equation, x);
  if (!is_stretch || !has_form(candidate, "x^3")) return std::nullopt;
  return Reading{"cubic stiffness in " + x.to_string(), Precedence::Contextual};
}

}  // namespace

const EffectFamily kCubicStiffness{
    {"cubic-stiffness", "A spring that hardens or softens with the cube of its stretch",
     "Duffing 1918"},
    "a clamped beam, a rubber mount, a saturating core",
    cubic_stiffness_forms,
    cubic_stiffness_reading};

}  // namespace lacuna
