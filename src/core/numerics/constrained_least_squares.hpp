// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// The solution of min |R h - c| subject to A h = b, with the directions that stay free around
/// it.
struct ConstrainedSolution {
  Vector h;          ///< q
  Vector variances;  ///< q: diagonal of N (N'R'RN)^-1 N', N spanning the null
                     ///< space of A; infinite where R and A do not determine h
};

/// Least squares under linear equality constraints by the null-space method: h = h_p + N z with
/// h_p the smallest solution of A h = b and z from min |R N z - (c - R h_p)| (Golub and Van
/// Loan, Matrix Computations, 4th ed., 6.2.3).
/// @param r any matrix with q columns. @param c as many entries as r has rows.
/// @param a constraints x q. @param b one entry for each.
/// @return NaN with infinite variances where an entry is not finite.
/// @throws ArgumentError when the shapes do not fit.
ConstrainedSolution constrained_least_squares(const Matrix& r, const Vector& c, const Matrix& a,
                                              const Vector& b);

/// The solution of min |R h - c|^2 / 2 subject to A h = b and G h <= g.
struct InequalitySolution {
  ConstrainedSolution solution;  ///< the active inequalities are equalities in its variances
  std::vector<Index> active;     ///< rows of G that hold as equalities, rising
  Vector multipliers;            ///< one for each row of G, >= 0, 0 where it is not active:
                                 ///< R'(c - R h) = A' mu + G' lambda
};

/// Least squares under linear inequalities by an active set: in coordinates in which the sum of
/// squares is a distance, the point that is closest to the solution without them is a problem of
/// non-negative least squares, whose positive unknowns are the multipliers (Lawson and Hanson,
/// Solving Least Squares Problems, 1974, ch. 23); those inequalities are equalities then. Of what
/// R does not determine the smallest solution is taken.
/// @param r any matrix with q columns. @param a, g_rows constraints x q.
/// @return nothing where no h satisfies all of them, or an entry is not finite.
/// @throws ArgumentError when the shapes do not fit.
std::optional<InequalitySolution> inequality_least_squares(const Matrix& r, const Vector& c,
                                                           const Matrix& a, const Vector& b,
                                                           const Matrix& g_rows,
                                                           const Vector& g);

/// Whether A h = b has a solution, to rounding; no where an entry is not finite.
/// @throws ArgumentError when A and b differ in rows.
bool is_feasible(const Matrix& a, const Vector& b);

}  // namespace lacuna
