// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The dataset without states that were computed from others.
Dataset measured_part(const Dataset& data);

/// What is known of the noise of measured_part(), which has no marks: nothing where these are.
std::optional<Vector> noise_of_measured_part(const Dataset& data,
                                             const std::optional<Vector>& noise);

/// The coefficients of a model that does not fit to the noise, by refine(): what it leaves is
/// correlated over time, so that the length of windows, and errors, have to come from the
/// record and not from its noise. Identities of the dataset stay.
/// @return nothing where the refinement did not converge.
std::optional<OdeModel> refitted(const OdeModel& model, const Dataset& data,
                                 const std::optional<Vector>& noise, const RunContext& context);

}  // namespace lacuna
