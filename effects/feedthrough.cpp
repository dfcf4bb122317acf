// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// Factors of the equation's products.
std::vector<std::string> factors(const Scope& scope, Index equation) {
  std::vector<std::string> result;
  for (const std::string& term : nonlinear_terms(scope, equation))
    for (const std::string& x :
         parse_expression(term, scope.model.variables().names()).variables())
      if (x != "t" && x != term) result.push_back(x);
  return result;
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const VariableRange& x : scope.variables)
    if (x.is_input && !has_term(scope, equation, x.name))
      result.push_back(plain_candidate(x.name, x.name, "direct path from the input " + x.name));
  for (const std::string& x : factors(scope, equation)) {
    const bool known = std::any_of(result.begin(), result.end(),
                                   [&](const Candidate& made) { return made.form == x; });
    if (known || has_term(scope, equation, x)) continue;
    result.push_back(plain_candidate(x, x, "feedthrough of the factor " + x));
    result.back().plainer = "linear-term";
  }
  return result;
}

}  // namespace

const EffectFamily kFeedthrough{
    {"feedthrough", "An input or a factor of a product leaks into the equation by itself", ""},
    "a multiplier's feedthrough, stray capacitance, crosstalk",
    {},
    make};

}  // namespace lacuna
