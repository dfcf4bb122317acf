// SPDX-License-Identifier: MIT
// What a fit did to the coefficients of a model.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/diagnose/diagnosis.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// The first `count` free coefficients of a fit, which are those of the nominal model, the most
/// significant change first.
std::vector<CoefficientChange> coefficient_changes(const OdeModel& nominal,
                                                   const Assimilation& fit, std::size_t count);

/// The pair of coefficients of an equation that is off most: with the change d of both and their
/// covariance C the combination with weights C^-1 d, whose square over its variance is d' C^-1 d
/// (Wald). Nothing where one coefficient is off by itself, or no pair beyond the significance that
/// allows for all that there are.
std::optional<CombinedChange> combined_change(const OdeModel& nominal, const Assimilation& fit,
                                              std::size_t count, double significance);

/// Largest rms of the change of a rate by the coefficients of a fit, over that of the rate.
double largest_rate_change(const OdeModel& nominal, const Assimilation& fit);

/// The model of a fit with standard errors and intervals of its free coefficients.
OdeModel with_intervals(const Assimilation& fit);

}  // namespace lacuna
