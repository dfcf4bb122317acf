// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& x : variable_names(scope))
    for (const std::string power : {"^4", "^5"})
      if (!has_term(scope, equation, x + power))
        result.push_back(plain_candidate(x + power, x, "term in " + x + power));
  return result;
}

}  // namespace

const EffectFamily kHigherOrderTerm{
    {"higher-order-term", "A term in the fourth or fifth power of a state or an input", ""},
    "a characteristic that bends late and strongly",
    {},
    make};

}  // namespace lacuna
