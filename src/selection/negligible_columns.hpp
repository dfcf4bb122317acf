// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/linear/negligible.hpp"
#include "window_search.hpp"

namespace lacuna {

/// A column that was left out, and why.
struct LeftOut {
  Coefficient column;
  double effect = 0.0;  ///< share of the rate of its equation that it was worth
};

/// Takes negligible columns out of the model, the one that is worth least to the trajectories
/// first, and settles what is left. Each equation keeps its last one; a price that was given
/// stands, and all terms with it.
std::vector<LeftOut> leave_out_negligible(const SearchTask& task, WindowSearch& search,
                                          const NegligibleTerms& rule,
                                          const RunContext& context);

}  // namespace lacuna
