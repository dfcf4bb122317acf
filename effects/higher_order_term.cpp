// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

constexpr const char* kPowers[] = {"x^4", "x^5"};

std::vector<Candidate> higher_order_term_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope))
    for (const char* power : kPowers) {
      const Expression form = formula(scope, power, {{"x", x}});
      if (!has_term(scope, equation, form)) result.push_back(plain_candidate(form, x));
    }
  return result;
}

std::optional<Reading> higher_order_term_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  for (const char* power : kPowers)
    if (is_variable(candidate.argument) && has_form(candidate, power))
      return Reading{"term in " + candidate.form.to_string()};
  return std::nullopt;
}

}  // namespace

const EffectFamily kHigherOrderTerm{
    {"higher-order-term", "A term in the fourth or fifth power of a state or an input", ""},
    "a characteristic that bends late and strongly",
    higher_order_term_forms,
    higher_order_term_reading};

}  // namespace lacuna
