// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "trajectories/subset_selection/subset_problem.hpp"

namespace lacuna {

/// Columns chosen and what they cost.
struct Subset {
  std::vector<Index> columns;  ///< increasing
  double score = 0.0;          ///< |y - A_S h|^2 + penalty |S|
};

/// What the subsets are exchanged for others by.
enum class Exchange {
  Single,  ///< one member for another column
  Pairs,   ///< in a last step two members for one column, too
};

/// Search for the subset S of columns that minimises |y - A_S h|^2 + penalty |S|: an l0
/// problem.
///
/// From each start (no column, all columns where that is possible, and `starts`), columns are
/// added while the best lowers the sum of squares by more than the penalty and removed while
/// the worst is worth less; then single columns, and in a last step pairs, are exchanged for
/// others until nothing helps. The best of all starts is returned. Columns that depend on those
/// chosen (a fraction below 1e-9 of them is new) are not added.
Subset best_subset(const SubsetProblem& problem, double penalty,
                   const std::vector<std::vector<Index>>& starts, Exchange exchange,
                   const RunContext& context = {});

}  // namespace lacuna
