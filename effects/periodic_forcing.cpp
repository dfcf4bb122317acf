// SPDX-License-Identifier: MIT
#include <numbers>

#include "lacuna/effects/families.hpp"
#include "lacuna/effects/forms.hpp"
#include "lacuna/effects/patterns.hpp"

namespace lacuna {
namespace {

using std::numbers::pi;

std::vector<Candidate> periodic_forcing_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const SpectralLine& line : scope.lines) {
    // A line of the spectrum is known to within the resolution of the record; what does not
    // come to two periods in it is a trend or a drift.
    const double resolution = 1.0 / scope.duration;
    if (line.equation != equation || line.frequency < 2.0 * resolution) continue;
    const Expression t = Expression::variable("t");
    Candidate candidate =
        plain_candidate(formula(scope, "sin(2*pi*frequency*t+phase)", {{"t", t}}), t);
    candidate.shapes = {{"frequency", "1/" + scope.model.time_unit(),
                         line.frequency - resolution, line.frequency + resolution, false},
                        {"phase", "rad", line.phase - pi, line.phase + pi, false}};
    candidate.starts = {Vector{{line.frequency, line.phase}}};
    candidate.repeats = true;
    result.push_back(candidate);
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
