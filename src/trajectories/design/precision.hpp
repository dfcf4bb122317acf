// SPDX-License-Identifier: MIT
// How well numbers are determined by an information matrix.
#pragma once

#include <vector>

#include "lacuna/trajectories/design/plan.hpp"

namespace lacuna {

/// Information on numbers, P x P each.
struct InformationParts {
  const Matrix& known;  ///< before an experiment
  const Matrix& added;  ///< by it; beside what chaotic paths add in some directions the rest is
                        ///< rounding, and counts as nothing
};

/// The larger the better. Numbers are taken in units of their sizes, so that no criterion depends
/// on units; what is singular counts as 1e-12 of the largest eigenvalue, and no experiment
/// determines a number to less than a millionth of its size.
/// @param size P, > 0; @param chosen for PrecisionCriterion::Chosen.
double precision_of(const InformationParts& information, const Vector& size,
                    PrecisionCriterion criterion, const std::vector<Index>& chosen = {});

/// Sizes of numbers, > 0: of 0 it is 1.
Vector sizes_of(const Vector& values);

/// Standard errors, P; NaN of a number that the information does not determine.
Vector errors_after(const InformationParts& information, const Vector& size);
Vector standard_errors(const Matrix& known, const Vector& size);

}  // namespace lacuna
