// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// Tests for each equation whether it holds exactly: the likelihood ratio of its disturbance
/// against none, the other variances fitted again. Half chi-squared with one degree of freedom
/// under the model, as a variance cannot be negative (Self and Liang, JASA 82 (1987)).
std::vector<EquationStructure> test_disturbances(const Assimilation& fit,
                                                 const RunContext& context);

/// Root mean square of each state's rate of change by the model along the paths, m entries.
Vector rate_rms(const Assimilation& fit);

/// How much the equations are disturbed together: the sum over the states in `rates` (the first
/// ones of the model) of (disturbance / rate)^2, time units.
/// @param rates rms of the rate of change of each, as of rate_rms(); a state at rest counts 0.
double total_disturbance(const Assimilation& fit, const Vector& rates);

/// Fraction, 0..1, of what disturbs a fit that another one of the same states does without; all
/// of nothing.
double fraction_closed(const Assimilation& before, const Assimilation& after);

/// Smoothed disturbances along one record, (n-1) x m, state unit per time unit.
Matrix disturbance_along(const Assimilation& fit, std::size_t record);

}  // namespace lacuna
