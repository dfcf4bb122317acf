// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> cubic_term_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope)) {
    const Expression power = formula(scope, "x^3", {{"x", x}});
    if (!has_term(scope, equation, power)) result.push_back(plain_candidate(power, x));
  }
  return result;
}

std::optional<Reading> cubic_term_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!is_variable(candidate.argument) || !has_form(candidate, "x^3")) return std::nullopt;
  return Reading{"cubic term in " + candidate.argument.name()};
}

}  // namespace

const EffectFamily kCubicTerm{{"cubic-term", "A term in the cube of a state or an input", ""},
                              "a symmetric characteristic that bends, an odd distortion",
                              cubic_term_forms,
                              cubic_term_reading};

}  // namespace lacuna
