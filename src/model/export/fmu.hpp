// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// Name of the shared library and of the model in an FMU.
inline constexpr const char* kFmuName = "lacuna_model";

/// What a functional mock-up unit of FMI 2.0 for co-simulation is made of.
struct FmuSources {
  std::string description;  ///< modelDescription.xml
  std::string code;         ///< C99 that needs the standard library alone: sources/lacuna_model.c
};

/// A model as an FMU. Variables are, in this order, states (outputs whose start may be set), inputs
/// (held over a communication step), parameters (tunable) and outputs that are no states; their
/// numbers are those of value references. Steps are solved by the method of Dormand and Prince
/// (order 5, error control at 1e-11 relative).
/// @throws ModelError as export_model() to C.
FmuSources fmu_sources(const SystemModel& model);

}  // namespace lacuna
