// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "identify/forms_beside/missing_forms.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/long_records.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The forms with shapes as the trajectories ask for: all coefficients of the model and all
/// shapes are fitted to the samples (refine()). As they were where that does not converge.
/// @param model with the terms of the equations, forms by their expressions.
std::vector<EquationForms> refined_shapes(const OdeModel& model,
                                          std::vector<EquationForms> equations,
                                          const RecordStream& records,
                                          const RunContext& context);

}  // namespace lacuna
