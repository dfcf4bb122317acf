// SPDX-License-Identifier: MIT
// How well numbers are determined by an information matrix.
#pragma once

#include <vector>

#include "lacuna/trajectories/design/plan.hpp"

namespace lacuna {

/// The larger the better. The matrix is scaled to numbers in units of their sizes first, so that
/// no criterion depends on units; what is singular counts as 1e-12 of the largest eigenvalue.
/// @param information P x P; @param size P, > 0; @param chosen for PrecisionCriterion::Chosen.
double precision_of(const Matrix& information, const Vector& size, PrecisionCriterion criterion,
                    const std::vector<Index>& chosen = {});

/// Sizes of numbers, > 0: of 0 it is 1.
Vector sizes_of(const Vector& values);

/// Standard errors, P; NaN of a number that the information does not determine.
Vector standard_errors(const Matrix& information, const Vector& size);

}  // namespace lacuna
