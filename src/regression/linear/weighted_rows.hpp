// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/row_source.hpp"

namespace lacuna {

/// Row weights from residuals, one tile at a time: weights(residuals) entry by entry.
using WeightFunction =
    std::function<void(const Eigen::Ref<const Vector>& residuals, Eigen::Ref<Vector> weights)>;

/// An equation with coefficients: y_k ~ Theta_A h.
struct FittedEquation {
  Index target = 0;     ///< k
  TermSet active;       ///< A
  Vector coefficients;  ///< h, one entry per active term
};

/// Residuals y_k - Theta_A h of some rows.
/// @param theta rows x L; @param targets rows x m; @param residuals rows.
void equation_residuals(const FittedEquation& equation, const Eigen::Ref<const Matrix>& theta,
                        const Eigen::Ref<const Matrix>& targets, Eigen::Ref<Vector> residuals);

/// Rows sqrt(w_i) [theta_i,A  y_ik] with w_i = weights(y_ik - theta_i,A h), made on demand.
/// Refers to `rows`. Reading throws ArgumentError when a weight is negative or not finite.
std::unique_ptr<RowSource> make_weighted_rows(const RowSource& rows, FittedEquation equation,
                                              WeightFunction weights);

}  // namespace lacuna
