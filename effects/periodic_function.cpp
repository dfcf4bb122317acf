// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numbers>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

using std::numbers::pi;

/// A wave over the place. Its wave number is known to within half a wave in the whole range.
Candidate wave_over(const Scope& scope, const Ripple& ripple) {
  constexpr double kKnown = 0.5;  // a fact of the periodogram: half the width of a peak
  const VariableRange& place = scope.state(ripple.position);
  const Expression x = Expression::variable(place.name);
  const double range = place.high - place.low, waves = range / ripple.period;
  Candidate candidate =
      plain_candidate(formula(scope, "sin(2*pi*x/period+phase)", {{"x", x}}), x);
  candidate.shapes = {{"period", place.unit, range / (waves + kKnown),
                       range / std::max(waves - kKnown, kFewestPeriods), true},
                      {"phase", "rad", -pi, pi, false}};
  candidate.starts = {Vector{{ripple.period, 0.0}}, Vector{{ripple.period, 0.5 * pi}}};
  candidate.repeats = true;
  return candidate;
}

std::vector<Candidate> periodic_function_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Ripple& ripple : scope.ripples)
    if (ripple.equation == equation) result.push_back(wave_over(scope, ripple));
  return result;
}

std::optional<Reading> periodic_function_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!has_form(candidate, "sin(2*pi*x/a+b)") ||
      !is_position(fitted.scope, candidate.equation, candidate.argument))
    return std::nullopt;
  return Reading{"a force that comes again along " + candidate.argument.to_string(),
                 Precedence::Plain,
                 {"period", "phase"}};
}

}  // namespace

const EffectFamily kPeriodicFunction{
    {"periodic-function", "A periodic function of a position", ""},
    "cogging of a motor, teeth of a gear, an eccentric wheel",
    periodic_function_forms,
    periodic_function_reading};

}  // namespace lacuna
