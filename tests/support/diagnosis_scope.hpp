// SPDX-License-Identifier: MIT
// A driven oscillator and its scope, for tests of effects.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/one_record.hpp"

namespace lacuna::support {

/// q' = v, v' = -4 q - 0.2 v + F.
inline OdeModel oscillator() {
  return parse_model(R"({"format": "lacuna.model/1", "time_unit": "s",
    "states": [{"name": "q", "unit": "m"}, {"name": "v", "unit": "m/s"}],
    "inputs": [{"name": "F", "unit": "N"}],
    "equations": [
      {"state": "q", "terms": [{"term": "v", "coefficient": 1.0}]},
      {"state": "v", "terms": [{"term": "q", "coefficient": -4.0},
        {"term": "v", "coefficient": -0.2}, {"term": "F", "coefficient": 1.0}]}]})",
                     "oscillator");
}

/// The same with damping that drives: it grows without bound.
inline OdeModel runaway() {
  std::vector<Equation> equations = oscillator().equations();
  for (WeightedTerm& summand : equations[1])
    if (summand.term.name() == "v") summand.coefficient = 0.2;
  return oscillator().with_equations(std::move(equations));
}

/// 1001 samples of 10 s; q swings in +-1, v in +-2, F in +-0.5.
inline Dataset oscillator_record() {
  Trajectory record;
  record.source = "made";
  record.time = Vector::LinSpaced(1001, 0.0, 10.0);
  record.states.resize(1001, 2);
  record.states.col(0) = (2.0 * record.time.array()).sin();
  record.states.col(1) = 2.0 * (2.0 * record.time.array()).cos();
  record.inputs = 0.5 * (3.0 * record.time.array()).sin().matrix();
  return support::one_record({{"q", "m"}, {"v", "m/s"}}, {{"F", "N"}}, record);
}

inline Scope oscillator_scope() {
  return make_scope(oscillator(), oscillator_record(), Vector::Constant(2, 0.01));
}

}  // namespace lacuna::support
