// SPDX-License-Identifier: MIT
#include "lacuna/effects/lag.hpp"

namespace lacuna {

std::string_view Lag::do_typical_cause() const {
  return "an amplifier's or actuator's bandwidth, a sensor's filter, a line";
}

std::vector<Candidate> Lag::do_candidates(const Scope& scope, Index equation) const {
  if (scope.is_identity(equation)) return {};
  std::vector<Candidate> result;
  const double shortest = 0.1 * scope.step;
  const double longest = 0.25 * scope.duration;
  for (const WeightedTerm& summand :
       scope.model.equations()[static_cast<std::size_t>(equation)]) {
    const std::string& term = summand.term.name();
    if (summand.term.expression().variables().empty()) continue;
    Candidate candidate;
    candidate.description = "lag of " + term + " in d" + scope.state(equation).name + "/dt";
    candidate.form = "lagged-(" + term + ")";
    candidate.memory = {{"lagged", "((" + term + ")-lagged)/tau", term}};
    candidate.shapes = {{"tau", scope.model.time_unit(), shortest, longest, true}};
    for (double tau = scope.step; tau < longest; tau *= 4.0)
      candidate.starts.emplace_back(Vector::Constant(1, tau));
    result.push_back(candidate);
  }
  return result;
}

}  // namespace lacuna
