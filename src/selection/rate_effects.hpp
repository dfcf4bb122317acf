// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "window_search.hpp"

namespace lacuna {

/// What terms are worth to the rates on a path, from the triangle of their columns of Theta.
class RateEffects {
 public:
  /// @param columns in any order. One pass over the windows of the path.
  RateEffects(WindowSearch& search, std::vector<Coefficient> columns);

  /// rms over the path of h_i d_i, as a share of that of the whole rate Theta h of its
  /// equation; d_i is column i without what the other members in its equation can say.
  /// @param members positions of columns; @param h their coefficients.
  Vector shares(const std::vector<Index>& members, const Vector& h) const;

 private:
  std::vector<Coefficient> columns_;
  std::vector<Index> places_;  ///< of each column in the triangle
  Matrix triangle_;            ///< R of the terms of all columns
};

}  // namespace lacuna
