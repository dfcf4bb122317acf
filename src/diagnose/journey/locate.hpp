// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/diagnose/diagnosis.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// Where a model and the records it was brought onto disagree: per equation how much, over
/// which range of which variable (a constant rate in the range, ranges between the deciles of
/// the samples), at which frequency.
std::vector<Disagreement> locate(const Assimilation& fit, const RunContext& context);

}  // namespace lacuna
