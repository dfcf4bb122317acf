// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/types.hpp"

namespace lacuna {

/// Low and high ends of 95 % intervals, P x 2.
Matrix intervals95(const Vector& values, const Vector& standard_errors, double freedom);

/// By how much the inverse of J'WJ, W the weights of Huber's loss, has to be multiplied for the
/// covariance of the estimate: mean(psi^2) mean(w) / mean(psi')^2 (Huber 1981, Sect. 7.6).
/// @param residuals whitened.
double robust_factor(const Matrix& residuals, double huber);

}  // namespace lacuna
