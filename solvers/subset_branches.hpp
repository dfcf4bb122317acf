// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "subset_fit.hpp"

namespace lacuna {

/// What a search for the best subset is bounded by.
struct SubsetBounds {
  Index most = 0;           ///< terms of a set
  double operations = 0.0;  ///< about so many, then it ends
};

/// The best set found.
struct BestSet {
  TermSet positions;  ///< increasing
  double score = 0.0;
  bool proved = true;  ///< no other set has a lower score
  Index branches = 0;  ///< looked at
};

/// The set of terms with the least score, by branch and bound.
/// @param start a set to begin with, independent terms: the better it is, the faster the
/// search.
BestSet best_set(const Subproblem& problem, const SubsetScore& score,
                 const SubsetBounds& bounds, const TermSet& start, const RunContext& context);

}  // namespace lacuna
