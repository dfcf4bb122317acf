// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// How far z is from the optimum of min |c - R z|^2 + sum_j p_j |z_j|: the largest violation of
///   |g_j| <= p_j where z_j = 0,  g_j = p_j sign(z_j) elsewhere,  g = 2 R'(c - R z),
/// divided by 2 (|c| + |R||z|), so that rounding gives about 1e-16.
double l1_violation(const L1Problem& problem, const Vector& z);

/// The exact optimum when `guess` shows which coefficients are zero and the signs of the
/// others: solves R_A'R_A z_A = R_A'c - sign(z_A) p_A / 2 and gives the result only if it
/// fulfils the optimality conditions to rounding. Coefficients that are small against the
/// largest are taken for zero or not, whichever fulfils them.
std::optional<Vector> l1_polished(const L1Problem& problem, const Vector& guess);

/// Descends from z over the coefficients that are not zero, as long as they keep their signs:
/// to the stationary point of these, or to where the first of them becomes zero, which then
/// stays so, and on. Never raises the objective, and ends after at most z.size() zeros; z comes
/// back where the columns of its nonzero coefficients are dependent. The inner step of the
/// feature-sign search (Lee, Battle, Raina & Ng, NIPS 19 (2007), Algorithm 1).
Vector l1_face_minimum(const L1Problem& problem, Vector z);

/// The solution to return from a solver's last point: polished where that succeeds.
/// @param tolerance the violation up to which an unpolished point counts as converged.
L1Solution l1_finished(const L1Problem& problem, const Vector& z, int iterations,
                       double tolerance);

}  // namespace lacuna
