// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "forms/candidate/tone.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> periodic_forcing_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const SpectralLine& line : scope.lines) {
    if (line.equation != equation || !is_tone(line, scope)) continue;
    result.push_back(tone_candidate(line, scope));
    result.back().repeats = true;
  }
  return result;
}

std::optional<Reading> periodic_forcing_reading(const FittedForm& fitted) {
  if (!has_form(fitted.candidate, "sin(2*pi*a*t+b)")) return std::nullopt;
  return Reading{"periodic forcing of d" + fitted.scope.state(fitted.candidate.equation).name +
                 "/dt"};
}

}  // namespace

const EffectFamily kPeriodicForcing{
    {"periodic-forcing", "A force of one frequency from outside", ""},
    "mains hum, an unbalance, the day, a neighbouring machine",
    periodic_forcing_forms,
    periodic_forcing_reading};

}  // namespace lacuna
