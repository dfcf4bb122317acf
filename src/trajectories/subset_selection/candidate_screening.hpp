// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "trajectories/refiners/window_search.hpp"

namespace lacuna {

/// Whether there are so many candidates that the problem of all of them in all equations, whose
/// cost is cubic in their number, is not to be set up: more than 250. Up to four states with
/// cubic monomials are below it.
bool is_wide(const SearchTask& task);

/// What rows that are cheap say of the candidates.
struct ScreenedCandidates {
  std::vector<Coefficient> worth;      ///< those worth their penalty, increasing
  std::vector<Coefficient> plausible;  ///< those, and the next best: several times as many, or
                                       ///< as there is room for in 250
};

/// Screens the candidates of each equation by itself. With the path x(t) taken for the
/// solution, each equation is linear in its coefficients alone,
///
///   x_k(t_i) - mean = sum_l h_l (int^t_i theta_l(x(t)) dt - mean)      in each window,
///
/// windows being the shortest ones, in which errors of the path have no time to grow. Theta is
/// the same for all equations: one Gram matrix of L + m columns. Columns are taken by
/// orthogonal least squares, those of the model as it is first, and then left out, the one that
/// is worth least first. Errors of the path bias this a little; the joint problem of the
/// plausible columns decides. About the path of a fitted model the residuals are its own, so
/// that what this finds worth its penalty is what the model lacks.
ScreenedCandidates screen_candidates(const SearchTask& task, WindowSearch& search,
                                     const RunContext& context);

}  // namespace lacuna
