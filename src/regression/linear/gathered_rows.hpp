// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// [Theta_A y], n x (|A| + 1), in memory: for methods that leave rows out or repeat them.
Matrix gathered_rows(const LeastSquaresSystem& system, Index target, const TermSet& active,
                     const RunContext& context);

/// R of the QR decomposition of some rows, or the rows themselves where they are fewer than
/// columns.
Matrix row_triangle(const Eigen::Ref<const Matrix>& rows);

/// Some rows of [Theta y] as the factor of a system of so many rows.
Factor factor_of_rows(Matrix rows, Index count);

}  // namespace lacuna
