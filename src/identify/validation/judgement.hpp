// SPDX-License-Identifier: MIT
// What errors of predictions say of a model.
#pragma once

#include "identify/validation/validate.hpp"

namespace lacuna {

/// Sets verdict and sentence of a validation whose tests have been made.
void judge(const ValidationOptions& options, Validation& validation);

}  // namespace lacuna
