// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
// Steps of a record that explicit methods cannot make, because the model is stiff.
#pragma once

#include <optional>

#include "trajectories/sensitivities/record_steps.hpp"

namespace lacuna {

/// Whether explicit steps, as many as there may be in each step of a record, are unstable for
/// d' = A d in some step.
/// @param slopes m^2 x grid.rows(n): A at begins, middles and ends; @param length n-1 entries.
bool has_stiff_steps(const Matrix& slopes, const StepGrid& grid, const Vector& length);

/// States at the ends of all steps from a path, (n-1) x m, by implicit steps; nothing where one
/// of them cannot be made, or where so many are needed that the path is none of the model's.
/// @param accuracy m: an error of a step that is small against it is good enough.
std::optional<Matrix> implicit_ends(Rates& rates, const StepSlots& slots,
                                    const Vector& accuracy);

/// What step_responses() is, by eight implicit parts of each step.
StepResponses implicit_responses(const Matrix& slopes, const StepGrid& grid,
                                 const Vector& length, Index states);

}  // namespace lacuna
