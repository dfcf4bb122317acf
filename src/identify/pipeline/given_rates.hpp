// SPDX-License-Identifier: MIT
// Records that bring derivatives.
#pragma once

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

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

}  // namespace lacuna
