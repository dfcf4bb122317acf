// SPDX-License-Identifier: MIT

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
    bound_to_term(scope, equation, term, candidate);
    for (double tau = scope.step; tau < longest; tau *= 4.0)
      candidate.starts.emplace_back(Vector::Constant(1, tau));
    result.push_back(candidate);
  }
  return result;
}

// Part of the term as it is fitted, or the whole of it.
bool plausible(const Scope&, const Candidate& candidate, const FittedCandidate& fitted) {
  return is_part_of_term(candidate, fitted);
}

}  // namespace

const EffectFamily kLag{
    {"lag", "A part of the model acts with finite bandwidth: one more pole", ""},
    "an amplifier's or actuator's bandwidth, a sensor's filter, a line",
    {},
    make,
    plausible};

}  // namespace lacuna
