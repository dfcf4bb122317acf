// SPDX-License-Identifier: MIT
// Records that bring derivatives.
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// Whether derivatives were measured, or are known: not made of the states.
bool has_given_rates(const Dataset& data);

/// A fraction of a rate that is rounding where rates are measured: a fact of digits.
inline constexpr double kRoundingOfRates = 1e-8;

/// What noise leaves of the equations of a model where derivatives are given, rms: their own by
/// their own differences (estimate_noise()), at least rounding, and that of the states through
/// the rates, sum_j (df_k/dx_j)^2 sigma_j^2, of a model without delays.
/// @param state_noise m. @return m, in state units per time unit.
Vector noise_of_given_rates(const OdeModel& model, const Dataset& data,
                            const Vector& state_noise);

/// Enters noise floors where they decide: that noise where a residual is more than twice it,
/// and rounding where it is no more. Between them there is none: differences of samples that do
/// not follow each other on a smooth path are no noise.
void note_floors_of_given_rates(const OdeModel& model, const Dataset& data,
                                const Vector& state_noise, std::vector<EquationFit>& fits);

}  // namespace lacuna
