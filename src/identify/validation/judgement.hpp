// SPDX-License-Identifier: MIT
// What errors of predictions say of a model.
#pragma once

#include <vector>

#include "identify/validation/validate.hpp"

namespace lacuna {

/// Sets verdict and sentence of a validation whose tests have been made, as admit() allows.
/// @param stages of the search that led to the model, done and left out.
void judge(const ValidationOptions& options, Validation& validation,
           const std::vector<StageDone>& stages = {});

}  // namespace lacuna
