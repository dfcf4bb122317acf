// SPDX-License-Identifier: MIT
#include <cmath>

#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  const double shortest = 0.1 * scope.step, longest = 0.25 * scope.duration;
  for (const WeightedTerm& summand :
       scope.model.equations()[static_cast<std::size_t>(equation)]) {
    const std::string& term = summand.term.name();
    if (summand.term.expression().variables().empty()) continue;
    Candidate candidate =
        shaped_candidate("$lagged-(" + term + ")", term,
                         "lag of " + term + " in d" + scope.state(equation).name + "/dt",
                         {"tau", scope.model.time_unit(), shortest, longest, true}, {});
    candidate.memory = {{"lagged", "((" + term + ")-$lagged)/$tau", term}};
    for (double tau = scope.step; tau < longest; tau *= 4.0)
      candidate.starts.emplace_back(Vector::Constant(1, tau));
    result.push_back(candidate);
  }
  return result;
}

// No more than the whole of a term can lag.
bool plausible(const Scope&, const Candidate& candidate, const FittedCandidate& fitted) {
  const double whole = fitted.nominal.coefficient(candidate.equation, candidate.argument);
  return whole * fitted.coefficient > 0.0 &&
         std::abs(fitted.coefficient) <= std::abs(whole) + 3.0 * fitted.deviation;
}

}  // namespace

const EffectFamily kLag{
    {"lag", "A part of the model acts with finite bandwidth: one more pole", ""},
    "an amplifier's or actuator's bandwidth, a sensor's filter, a line",
    {},
    make,
    plausible};

}  // namespace lacuna
