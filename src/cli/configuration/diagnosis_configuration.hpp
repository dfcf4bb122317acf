// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

/// How a model is diagnosed, from a configuration with the keys
///   decision    thresholds by name: {"significance": 2.5}
///   criterion   a name, or an object with "type" and options
///   hypotheses  names of those that are judged; all that are registered by default
///   effects     names of those that are tried; all that are registered by default
///   fill_gap    whether a black-box function stands in for what has no name
/// @throws ConfigError naming the JSON path: an unknown key or name (with the nearest known
///   one), a value of the wrong type or out of range.
DiagnosisOptions diagnosis_options(const Configuration& configuration,
                                   const Registry& registry);

}  // namespace lacuna
