// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> lag_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  const double shortest = 0.1 * scope.step, longest = 0.25 * scope.duration;
  for (const WeightedTerm& summand :
       scope.model.equations()[static_cast<std::size_t>(equation)]) {
    const Expression& term = summand.term.expression();
    if (term.variables().empty()) continue;
    Candidate candidate =
        shaped_candidate(formula(scope, "lagged-x", {{"x", term}}), term,
                         {"tau", scope.model.time_unit(), shortest, longest, true}, {});
    candidate.memory = {{"lagged", formula(scope, "(x-lagged)/tau", {{"x", term}}), term}};
    bound_to_term(scope, equation, term, candidate);
    for (double tau = scope.step / 3.0; tau < longest; tau *= 4.0)
      candidate.starts.emplace_back(Vector::Constant(1, tau));
    result.push_back(candidate);
  }
  return result;
}

// Part of the term as it is fitted, or the whole of it.
std::optional<Reading> lag_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!has_form(candidate, "m-x") || !is_part_of_term(fitted)) return std::nullopt;
  return Reading{"lag of " + candidate.argument.to_string() + " in d" +
                 fitted.scope.state(candidate.equation).name + "/dt"};
}

}  // namespace

const EffectFamily kLag{
    {"lag", "A part of the model acts with finite bandwidth: one more pole", ""},
    "an amplifier's or actuator's bandwidth, a sensor's filter, a line",
    lag_forms,
    lag_reading};

}  // namespace lacuna
