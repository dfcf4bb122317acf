// SPDX-License-Identifier: MIT
#pragma once

#include "support/settings.hpp"

namespace lacuna::benchmarks {

/// What `identify` says of models of all flows, from records of all makings: those that have
/// exactly the true terms, and those of flows whose terms the library lacks. For floors of the
/// verdict (ValidationOptions::resolution) at half, one and double.
/// Tables go to the folder at place 1. @return exit status. @throws as run_cells().
int write_verdicts(const StudyArguments& arguments);

}  // namespace lacuna::benchmarks
