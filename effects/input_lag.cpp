// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

/// A term with an input that comes late into it: an actuator with a pole before a curve.
Candidate lagging_within(const Scope& scope, Index equation, const Expression& term,
                         const Expression& input) {
  const double shortest = 0.1 * scope.step, longest = 0.25 * scope.duration;
  const std::string lagged = scope.free_name("lagged");
  const Expression late = substitute(term, {{input.name(), Expression::variable(lagged)}});
  Candidate candidate = shaped_candidate(
      late - term, input,
      {scope.free_name("tau"), scope.model.time_unit(), shortest, longest, true}, {});
  candidate.within = term;
  candidate.memory = {{lagged, formula(scope, "(x-lagged)/tau", {{"x", input}}), input}};
  bound_to_term(scope, equation, term, candidate);
  for (double tau = scope.step / 3.0; tau < longest; tau *= 4.0)
    candidate.starts.emplace_back(Vector::Constant(1, tau));
  return candidate;
}

std::vector<Candidate> input_lag_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& term : nonlinear_terms(scope, equation))
    for (const std::string& name : term.variables())
      if (const Expression x = Expression::variable(name); is_input(scope, x))
        result.push_back(lagging_within(scope, equation, term, x));
  return result;
}

std::optional<Reading> input_lag_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!candidate.within || candidate.memory.size() != 1 || candidate.memory.front().driven ||
      !is_input(fitted.scope, candidate.argument))
    return std::nullopt;
  const Expression late = Expression::variable(candidate.memory.front().name);
  const Expression& term = *candidate.within;
  if (!(candidate.form == substitute(term, {{candidate.argument.name(), late}}) - term))
    return std::nullopt;
  if (!is_part_of(fitted, term)) return std::nullopt;
  return Reading{"lag of " + candidate.argument.to_string() + " before " + term.to_string(),
                 Precedence::Plain,
                 {"tau"}};
}

}  // namespace

const EffectFamily kInputLag{
    {"input-lag", "An input passes a pole before the curve by which it acts", ""},
    "a propeller that spins up, a valve that opens, a heater's mass",
    input_lag_forms,
    input_lag_reading};

}  // namespace lacuna
