// SPDX-License-Identifier: MIT
// Records that are validated.
#pragma once

#include <string>

#include "bases/expressions.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "identify/validation/validate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::testing {

/// As a measurement gives it: without derivatives.
inline Dataset measured(Dataset data, double noise, std::uint64_t seed = 1) {
  for (Trajectory& record : data.trajectories) record.derivatives.resize(0, 0);
  return noise > 0.0 ? add_relative_noise(data, noise, seed) : data;
}

inline Dataset lorenz_record(double noise, Index samples = 4000, std::uint64_t seed = 1) {
  const TestSystem& lorenz = test_system("lorenz");
  return measured(record_of(lorenz.model, Dopri87{}, lorenz.start, 0.01, samples), noise, seed);
}

/// Of equations as a text model, without noise.
inline Dataset record_of_text(const std::string& text, const Vector& start, double step,
                              Index samples) {
  return measured(record_of(parse_ode(text, "test"), Dopri87{}, start, step, samples), 0.0);
}

/// A pipeline with these candidate terms for all equations.
inline Pipeline with_terms(const std::vector<std::string>& terms) {
  Pipeline pipeline = algorithm1();
  pipeline.basis = Expressions{{.terms = terms}};
  return pipeline;
}

inline Validation validated(const Dataset& data, const Pipeline& pipeline) {
  const IdentificationResult found = identify(data, pipeline);
  return validate({found, data, pipeline});
}

}  // namespace lacuna::testing
