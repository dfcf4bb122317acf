// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "trajectories/subset_selection/subset_problem.hpp"

namespace lacuna {

/// Fraction of a column that is not rounding.
inline constexpr double kNewFraction = 1e-9;

/// All scaled columns without what a subset explains.
struct DeflatedColumns {
  Matrix columns;  ///< (q + 1) x (q + 1), the last one is the target
  Vector sizes;    ///< squared norms, q

  /// Whether so much of a column is left that it is none of those taken out.
  bool is_new(Index j) const { return sizes[j] > kNewFraction * kNewFraction; }

  /// Takes column j out of all others.
  void take(Index j);

  /// Decrease of |y|^2 by each column.
  Vector gains() const;
};

DeflatedColumns deflate(const SubsetProblem& problem, const std::vector<Index>& subset);

}  // namespace lacuna
