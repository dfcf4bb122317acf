// SPDX-License-Identifier: MIT
// Models held against each other by their free runs.
#pragma once

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// -2 log likelihood of free runs of a model through records, coefficients and initial states
/// fitted (fit()), plus ln n for each coefficient (Schwarz): of two models the one with the
/// smaller value. Infinite where no free run is finite.
/// @param data records that models are compared on; no more than so many samples of them count as
///   a fit takes in a second.
double free_run_criterion(const OdeModel& model, const Dataset& data, const RunContext& context);

}  // namespace lacuna
