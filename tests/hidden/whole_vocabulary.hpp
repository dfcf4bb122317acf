// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/diagnose/diagnose.hpp"

namespace lacuna::hidden {

/// The diagnosis of a model with every effect there is.
inline Diagnosis diagnosis_of(const OdeModel& nominal, const Dataset& find,
                              const Dataset& check) {
  DiagnosisOptions options;
  options.effects = default_registry().make_all<Effect>();
  return diagnose(nominal, find, check, options, RunContext{});
}

}  // namespace lacuna::hidden
