// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> cross_term_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  const std::vector<Expression> all = all_variables(scope);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      for (const char* product : {"x*y", "x^2*y", "x*y^2"}) {
        const Expression form = formula(scope, product, {{"x", all[i]}, {"y", all[j]}});
        if (!has_term(scope, equation, form)) result.push_back(plain_candidate(form, form));
      }
  return result;
}

// A monomial of several variables, time not among them.
std::optional<Reading> cross_term_reading(const FittedForm& fitted) {
  // By definition: products of a higher degree are higher-order terms.
  constexpr int kHighest = 3;
  const Candidate& candidate = fitted.candidate;
  if (!candidate.shapes.empty() || !candidate.memory.empty()) return std::nullopt;
  const Term term(candidate.form, fitted.scope.model.variables());
  const auto exponents = term.exponents();
  if (!exponents || exponents->back() != 0) return std::nullopt;
  const std::vector<int>& powers = *exponents;
  const auto factors =
      std::count_if(powers.begin(), powers.end(), [](int power) { return power > 0; });
  const bool negative =
      std::any_of(powers.begin(), powers.end(), [](int power) { return power < 0; });
  if (negative || factors < 2 || std::accumulate(powers.begin(), powers.end(), 0) > kHighest)
    return std::nullopt;
  return Reading{"product " + candidate.form.to_string()};
}

}  // namespace

const EffectFamily kCrossTerm{
    {"cross-term", "A product of different states or inputs, up to degree 3", ""},
    "a multiplier, a gyroscopic or Coriolis force, mass action, a controlled part",
    cross_term_forms,
    cross_term_reading};

}  // namespace lacuna
