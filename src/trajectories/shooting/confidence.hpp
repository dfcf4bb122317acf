// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Low and high ends of 95 % intervals, P x 2.
Matrix intervals95(const Vector& values, const Vector& standard_errors, double freedom);

/// By how much the inverse of J'WJ, W the weights of Huber's loss, has to be multiplied for the
/// covariance of the estimate: mean(psi^2) mean(w) / mean(psi')^2 (Huber 1981, Sect. 7.6).
/// @param residuals whitened.
double robust_factor(const Matrix& residuals, double huber);

/// Blocks of block_covariance(): enough for standard errors good to an eighth, few enough to be
/// long.
inline constexpr Index kCovarianceBlocks = 30;

/// Covariance of the estimate when residuals are correlated over time, as those of a model that
/// is not exact are: (J'J)^-1 (sum_b g_b g_b') (J'J)^-1 with g_b the gradients of blocks of
/// neighbouring windows (Liang and Zeger, Biometrika 73:13-22, 1986).
/// @param windows R of [S_a S_p | r] of each window in order; @param inverse (J'J)^-1, P x P.
/// @return nothing when there are not twice as many windows as parameters.
std::optional<Matrix> block_covariance(const std::vector<Matrix>& windows,
                                       const Matrix& inverse);

}  // namespace lacuna
