// SPDX-License-Identifier: MIT
#pragma once

#include "trajectories/windows/shooting_record.hpp"

namespace lacuna {

/// States at all samples to start from, N x m: the samples themselves where a state is
/// measured; a state without a column from an equation of a known state in which it is the only
/// unknown and stands linearly, x_j = (dx_k/dt - f_k|x_j=0) / (df_k/dx_j), with dx_k/dt from
/// local polynomials (dq/dt = v gives v).
/// @param signals of one step per sample.
/// @param sigma noise of each measured state: how much the polynomials have to smooth.
/// @throws DataError naming a state that no equation defines.
Matrix guess_states(const ParametrisedModel& model, const ShootingRecord& record, Rates& rates,
                    const StageSignals& signals, const Vector& sigma);

/// Derivatives of samples by local quadratics over as many neighbours as fit to within the
/// noise: N.
Vector smooth_derivative(const ShootingRecord& record, const Eigen::Ref<const Vector>& values,
                         double sigma);

}  // namespace lacuna
