// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "forms/candidate/tone.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

Candidate swinging(const SpectralLine& line, const Scope& scope, const Expression& term) {
  Candidate candidate = tone_candidate(line, scope);
  candidate.form = term * candidate.form;
  candidate.argument = term;
  return candidate;
}

std::vector<Candidate> periodic_parameter_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  if (!determines_time(scope)) return result;
  for (const auto& [line, term] : scope.modulations)
    if (line.equation == equation && is_tone(line, scope))
      result.push_back(swinging(line, scope, term));
  return result;
}

std::optional<Reading> periodic_parameter_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!has_form(candidate, "x*sin(2*pi*a*t+b)") ||
      !has_term(fitted.scope, candidate.equation, candidate.argument))
    return std::nullopt;
  return Reading{"coefficient of " + candidate.argument.to_string() +
                 " that swings with one frequency"};
}

}  // namespace

const EffectFamily kPeriodicParameter{
    {"periodic-parameter", "A coefficient that swings with one frequency", "Mathieu 1868"},
    "the season, the day, a pump, a crank, a rotor out of round",
    periodic_parameter_forms,
    periodic_parameter_reading};

}  // namespace lacuna
