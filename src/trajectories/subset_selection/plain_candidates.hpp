// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "trajectories/refiners/window_search.hpp"

namespace lacuna {

/// The task without candidates that a relation of the record writes in lower ones: multiples of
/// the highest summands of sum_j c_j phi_j = value. On a circle x^3 + x y^2 is x, and what
/// distinguishes them is noise. Nothing where no candidate is one of them, or constraints name
/// terms.
/// @param strength what summands of a relation vary by, in units of its scatter.
std::optional<SearchTask> plain_task(const SearchTask& task, double strength,
                                     const RunContext& context = {});

/// Whether a fit has terms that are no candidates of the task.
bool has_other_terms(const SearchTask& plain, const WindowFit& fit);

}  // namespace lacuna
