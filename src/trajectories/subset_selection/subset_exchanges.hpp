// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "deflated_columns.hpp"

namespace lacuna {

/// What taking members out of a subset gives back to all other columns: directions d_i in the
/// span of the subset that are orthogonal to all its other members.
struct SubsetExchanges {
  DeflatedColumns deflated;
  Matrix fractions;   ///< k x (q + 1): of each direction in every column; the target last
  Matrix directions;  ///< (q + 1) x k, unit
  Vector products;    ///< q: of the deflated columns with the deflated target
  double residual = 0.0;
};

SubsetExchanges exchanges_of(const SubsetProblem& problem, const std::vector<Index>& subset);

/// The best column to take in when members i and j (the same one: only that) leave, if that
/// lowers the sum of squares below a limit.
std::optional<Index> replacement(const SubsetExchanges& exchanges, Index i, Index j,
                                 double limit);

}  // namespace lacuna
