// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& x : variable_names(scope))
    if (!has_term(scope, equation, x + "^2"))
      result.push_back(plain_candidate(x + "^2", x, "quadratic term in " + x));
  return result;
}

}  // namespace

const EffectFamily kQuadraticTerm{
    {"quadratic-term", "A term in the square of a state or an input", ""},
    "an asymmetric characteristic, an even distortion, crowding",
    {},
    make};

}  // namespace lacuna
