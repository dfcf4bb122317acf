// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

bool is_input(const Scope& scope, const std::string& name) {
  for (const VariableRange& variable : scope.variables)
    if (variable.name == name) return variable.is_input;
  return false;
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& x : variable_names(scope)) {
    if (has_term(scope, equation, x)) continue;
    result.push_back(plain_candidate(x, x, "linear term in " + x));
    // A path from an input, or between parts that the model keeps apart, has a name of its own.
    if (is_input(scope, x)) result.back().plainer = "feedthrough";
    if (in_other_part(scope, equation, x)) result.back().plainer = "missing-coupling";
  }
  return result;
}

}  // namespace

const EffectFamily kLinearTerm{
    {"linear-term", "A term proportional to a state or an input", ""},
    "a forgotten resistor, damper, spring or path",
    {},
    make};

}  // namespace lacuna
