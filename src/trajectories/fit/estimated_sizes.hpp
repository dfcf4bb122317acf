// SPDX-License-Identifier: MIT
// What it costs that sizes of the noise are estimated from the records that they weigh.
#pragma once

#include "fit_solver.hpp"

namespace lacuna {

/// What is uncertain of the global numbers because one size of the noise for each channel is
/// estimated, with the same part of its values as degrees of freedom.
///
/// With H the projection on the columns of all unknowns in deviations of the noise, H_cd its block
/// of channels c and d, and V_c the rows of a channel by orthonormal global numbers,
/// - the variance of a channel is that of its residuals over n_c - tr H_cc, r_c times that of the
///   fit;
/// - the information of ln(sigma_c^2) is that of the restricted likelihood,
///     I_cd = (delta_cd (n_c - 2 tr H_cc) + tr(H_cd H_dc)) / 2,  W = I^-1;
/// - the covariance R^-1 R^-T of the global numbers grows by
///     R^-1 (sum_c (r_c - 1 + 2 W_cc) V_c'V_c - 2 sum_cd W_cd V_c' H_cd V_d) R^-T
///   (Kenward and Roger, Biometrics 53:983-997, 1997; to the order 1/n).
/// Where one channel has all samples, nothing grows and the degrees of freedom are n - unknowns.
struct EstimatedSizes {
  Vector freedom;  ///< G: degrees of freedom of the variance of each number (Satterthwaite)
  Matrix added;    ///< G x G: what the covariance grows by
};

/// @param linear of the same minimum, without gains. @param kept places of the global numbers that
///   are not held.
EstimatedSizes estimated_sizes(FitEngine& engine, const FitUnknowns& unknowns,
                               const FitMinimum& minimum, const FitLinear& linear,
                               const std::vector<Index>& kept);

}  // namespace lacuna
