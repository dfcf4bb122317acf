// SPDX-License-Identifier: MIT
// What a fit did to the coefficients of a model.
#pragma once

#include <vector>

#include "lacuna/diagnose/journey/diagnosis.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// The first `count` free coefficients of a fit, which are those of the nominal model, the most
/// significant change first.
std::vector<CoefficientChange> coefficient_changes(const OdeModel& nominal,
                                                   const Assimilation& fit, std::size_t count);

/// Largest rms of the change of a rate by the coefficients of a fit, over that of the rate.
double largest_rate_change(const OdeModel& nominal, const Assimilation& fit);

/// The model of a fit with standard errors and intervals of its free coefficients.
OdeModel with_intervals(const Assimilation& fit);

}  // namespace lacuna
