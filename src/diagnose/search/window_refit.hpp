// SPDX-License-Identifier: MIT
// Coefficients that hold over windows of time, for models that leave structure over.
#pragma once

#include <optional>

#include "lacuna/diagnose/hypotheses/problem.hpp"

namespace lacuna {

/// Fits the coefficients of an explanation that leaves structure to the trajectories
/// (refine()). The likelihood of the innovations takes the residual for a white disturbance of
/// each step and gives way to what happens within a step or two, however small its part in the
/// motion; solutions over windows weigh it as the motion does, and blocks of the record show
/// how sure the coefficients are.
/// @return nothing where the explanation has delays, memory or terms in what is measured,
///   where the records hold fewer than `long_window` windows of as many mean periods, or where
///   the gap in windows (window_gap()) is more than negligibly larger with the new
///   coefficients.
std::optional<Explanation> refit_over_windows(const Problem& problem, const Baseline& base,
                                              const Explanation& explanation);

}  // namespace lacuna
