// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/numerics/negligible.hpp"
#include "trajectories/refiners/window_search.hpp"

namespace lacuna {

/// What terms are worth to the rates on a path, from the triangle of their columns of Theta.
class RateEffects {
 public:
  /// @param columns in any order. One pass over the windows of the path.
  RateEffects(WindowSearch& search, std::vector<Coefficient> columns);

  /// rms over the path of h_i d_i, as a fraction of that of the whole rate Theta h of its
  /// equation; d_i is column i without what the other members in its equation can say.
  /// @param members positions of columns; @param h their coefficients.
  Vector fractions(const std::vector<Index>& members, const Vector& h) const;

 private:
  std::vector<Coefficient> columns_;
  std::vector<Index> places_;  ///< of each column in the triangle
  Matrix triangle_;            ///< R of the terms of all columns
};

/// A column that was left out, and why.
struct LeftOut {
  Coefficient column;
  double effect = 0.0;     ///< fraction of the rate of its equation that it was worth
  double threshold = 0.0;  ///< that it was not worth
};

/// Takes negligible columns out of the model, the one that is worth least to the trajectories
/// first, and settles the rest. Each equation keeps its last one; a penalty that was given
/// stands, and all terms with it.
std::vector<LeftOut> leave_out_negligible(const SearchTask& task, WindowSearch& search,
                                          const NegligibleTerms& rule,
                                          const RunContext& context);

}  // namespace lacuna
