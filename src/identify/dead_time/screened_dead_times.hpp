// SPDX-License-Identifier: MIT
// Dead times by the rows of derivatives.
#pragma once

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// The dead times with which the whole library of a pipeline leaves least of the derivatives,
/// in whole sampling steps, one input after the other until none changes. Derivatives are those
/// of means (averaged()) over ever more samples; the width counts at which dead times gain
/// most: the sum over equations of n ln(residual^2), n of the windows that fit into the
/// records, less ln n for a time and twice the log of the number of times tried for its choice.
/// @param given times of each input that are known; others are sought.
/// @return time units, one per input; all 0 where records are too short for the library.
Vector screened_dead_times(const Dataset& data, const Pipeline& pipeline,
                           const DeadTimeOptions& options,
                           const std::vector<std::optional<double>>& given,
                           const RunContext& context);

}  // namespace lacuna
