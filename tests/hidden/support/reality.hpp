// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "diagnose/journey/gap.hpp"
#include "hidden/support/records.hpp"

namespace lacuna::hidden {

/// The gap of a model on a measured record, recomputed without the code of the diagnosis: the
/// record is cut into windows of `gap.window`, the model is simulated in each from the state
/// that the record has there *without noise*, and
///
///   gap^2 = mean over states of (mean square of (clean - simulated)
///           + mean square of (measured - clean)) / variance of the measured state.
///
/// Nothing when the model has states or delays that the record does not show, or diverges.
std::optional<double> real_gap(const OdeModel& model, const Dataset& clean,
                               const Dataset& measured, const Gap& gap);

/// The gap of the true model of a case on a record, as measure_gap() has it; nothing where the
/// record does not show all of its states.
std::optional<double> true_gap(const HiddenCase& hidden, const Dataset& measured);

}  // namespace lacuna::hidden
