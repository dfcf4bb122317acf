// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// The least-squares problems min |y - A_S h|^2 in all subsets S of the q columns of A, the
/// rows being white with unit variance, as the triangular factor R of [A y].
struct SubsetProblem {
  Matrix scaled;  ///< R, (q + 1) x (q + 1), its first q columns of unit length or 0
  Vector norms;   ///< q: lengths of the columns of A

  Index columns() const noexcept { return norms.size(); }
};

/// @param triangle R, upper triangular; the last column is the target.
/// @throws ArgumentError when it is empty.
SubsetProblem subset_problem(const Matrix& triangle);

/// Least squares in a subset.
struct SubsetFit {
  Matrix inverse;         ///< k x k: of the triangle of the scaled columns
  Vector solution;        ///< k: coefficients of the scaled columns
  double residual = 0.0;  ///< |y - A_S h|^2
};

/// Not finite where columns of the subset depend on each other. @throws ArgumentError when
///   there are no such columns; the same below.
SubsetFit fit_subset(const SubsetProblem& problem, const std::vector<Index>& subset);

/// Increase of the sum of squares when each member leaves, in the order of the subset.
Vector losses_of(const SubsetFit& fit);

/// Decrease of the sum of squares when each column joins the subset (0 for those in it).
Vector gains_of(const SubsetProblem& problem, const std::vector<Index>& subset);

/// Coefficients h of a subset, in the units of the columns of A.
/// Not finite where columns of the subset depend on each other.
Vector solution_of(const SubsetProblem& problem, const std::vector<Index>& subset);

/// Diagonal of (A_S' A_S)^-1.
/// Not finite where columns of the subset depend on each other.
Vector variances_of(const SubsetProblem& problem, const std::vector<Index>& subset);

}  // namespace lacuna
