// SPDX-License-Identifier: MIT
#include "forms/candidate/tone.hpp"

#include <algorithm>
#include <numbers>

namespace lacuna {

bool is_tone(const SpectralLine& line, const Scope& scope) {
  return line.frequency * scope.duration >= kFewestPeriods;
}

Candidate tone_candidate(const SpectralLine& line, const Scope& scope) {
  using std::numbers::pi;
  const std::string frequency = scope.free_name("frequency"), phase = scope.free_name("phase");
  const double resolution = 1.0 / scope.duration;
  Candidate candidate;
  candidate.form = parse_expression("sin(2*pi*" + frequency + "*t+" + phase + ")");
  candidate.argument = Expression::variable("t");
  candidate.shapes = {{frequency, "1/" + scope.model.time_unit(),
                       std::max(line.frequency - resolution, kFewestPeriods * resolution),
                       line.frequency + resolution, false},
                      {phase, "rad", line.phase - pi, line.phase + pi, false}};
  candidate.starts = {Vector{{line.frequency, line.phase}}};
  candidate.equation = line.equation;
  return candidate;
}

}  // namespace lacuna
