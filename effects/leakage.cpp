// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  const VariableRange& x = scope.state(equation);
  std::vector<Candidate> result;
  const std::string outflow = "sqrt(max(" + x.name + ",0))";
  if (x.is_amount() && !has_term(scope, equation, "sqrt(" + x.name + ")"))
    result.push_back(plain_candidate(outflow, x.name, "outflow of " + x.name + " by a hole"));
  if (!has_term(scope, equation, x.name) && !is_velocity(scope, equation)) {
    result.push_back(plain_candidate(x.name, x.name, "leakage of " + x.name));
    result.back().plainer = "linear-term";
  }
  return result;
}

}  // namespace

const EffectFamily kLeakage{{"leakage", "What is stored gets lost by itself",
                             "Torricelli's law for the outflow of a tank"},
                            "a leaky capacitor, a hole, a seal, heat loss",
                            {},
                            make,
                            opposes};

}  // namespace lacuna
