// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A least-squares problem |c - R z|^2 + rho^2 in triangular form.
struct TriangularProblem {
  Matrix triangle;        ///< R, k x k
  Vector target;          ///< c, k
  double residual = 0.0;  ///< rho
};

/// Makes columns of a triangle triangular again by Householder reflections.
/// @param columns h x k; column j is zero below row heights[j].
/// @param heights strictly increasing.
/// @param target h, in the same coordinates.
/// @throws ArgumentError when shapes do not fit.
TriangularProblem retriangularise(Matrix columns, Vector target, const TermSet& heights);

/// Takes column `position` out by Givens rotations; what it alone explained goes to rho.
/// @throws ArgumentError when there is no such column.
void remove_column(TriangularProblem& problem, Index position);

/// Smallest |R_ii| of unit columns that rounding in `rows` rows cannot have made.
/// @throws ArgumentError for negative numbers.
double rank_tolerance(Index columns, Index rows);

/// Columns whose diagonal is at most tolerance * max |R_ii| when the earlier such columns have
/// been taken out: the data do not determine them beside the columns before them. Takes them
/// out.
/// @return their positions, increasing.
TermSet remove_dependent_columns(TriangularProblem& problem, double tolerance);

/// Whether some |R_ii| is at most tolerance * max |R_ii|.
bool is_rank_deficient(const Matrix& triangle, double tolerance);

/// |R^-1|_1 from below (Hager 1984, as in Higham 2002, algorithm 15.1): climbs along the gradient
/// of |R^-1 x|_1 over unit vectors, O(k^2). Infinite when a diagonal entry is zero.
double inverse_norm_estimate(const Matrix& triangle);

/// Estimate of |R|_1 |R^-1|_1, likewise.
double condition_estimate(const Matrix& triangle);

}  // namespace lacuna
