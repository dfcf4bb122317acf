// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> quadratic_term_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope)) {
    const Expression power = formula(scope, "x^2", {{"x", x}});
    if (!has_term(scope, equation, power)) result.push_back(plain_candidate(power, x));
  }
  return result;
}

std::optional<Reading> quadratic_term_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!is_variable(candidate.argument) || !has_form(candidate, "x^2")) return std::nullopt;
  return Reading{"quadratic term in " + candidate.argument.name()};
}

}  // namespace

const EffectFamily kQuadraticTerm{
    {"quadratic-term", "A term in the square of a state or an input", ""},
    "an asymmetric characteristic, an even distortion, crowding",
    quadratic_term_forms,
    quadratic_term_reading};

}  // namespace lacuna
