// SPDX-License-Identifier: MIT
// The nominal oscillator brought onto records with something hidden in them.
#pragma once

#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna::support {

inline AssimilationOptions oscillator_fit_options() {
  AssimilationOptions options;
  options.free = free_coefficients(oscillator());
  return options;
}

inline Assimilation assimilated(const Dataset& data) {
  return assimilate(oscillator(), as_measured(data), oscillator_fit_options(), RunContext{});
}

inline double dry_friction(double, double, double v) { return -0.3 * (v > 0.0 ? 1.0 : -1.0); }

/// A candidate without shapes in dv/dt.
inline Candidate plain_candidate(const std::string& form) {
  Candidate candidate;
  candidate.form = candidate.argument = parse_expression(form);
  candidate.families = {"test"};
  candidate.equation = 1;
  candidate.starts = {Vector(0)};
  return candidate;
}

/// min(q - edge, 0) in dv/dt.
inline Candidate stop_candidate(double start) {
  Candidate candidate = plain_candidate("min(q-edge,0)");
  candidate.shapes = {{"edge", "m", -1.0, 1.0, false}};
  candidate.starts = {Vector::Constant(1, start)};
  return candidate;
}

}  // namespace lacuna::support
