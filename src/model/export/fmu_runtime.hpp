// SPDX-License-Identifier: MIT
#pragma once

namespace lacuna {

/// The functions of FMI 2.0 for co-simulation in C99, behind the functions of a model, the sizes
/// LACUNA_STATES, ..., the arrays of starts and LACUNA_GUID.
extern const char* const kFmuRuntime;

}  // namespace lacuna
