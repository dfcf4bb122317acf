// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Columns in the order in which orthogonal least squares takes them.
struct ForwardOrder {
  std::vector<Index> columns;
  double left = 0.0;  ///< |y - A h|^2 of the columns taken
};

/// Which columns are taken, and how many.
struct ForwardLimits {
  std::vector<Index> first = {};  ///< taken before all others
  Index fewest = 0;               ///< taken in any case, as far as there are so many
  double enough = 0.0;            ///< more are taken as long as more than this is left
  std::vector<Index> only = {};   ///< no others are taken, increasing; empty: any
};

/// Takes the column of A (h x q) that lowers |y - A h|^2 most beside those taken before it, one
/// after the other: O(h q) each. Columns of which less than a millionth is new are left out.
/// (Chen, Billings, Luo 1989, with modified inner products instead of deflated columns.)
/// Columns that are not finite are left out; of such a target none is taken and NaN is left.
/// @throws ArgumentError when columns and target differ in rows, or a named one does not exist.
ForwardOrder forward_order(const Eigen::Ref<const Matrix>& columns, const Vector& target,
                           const ForwardLimits& limits, const RunContext& context = {});

/// The same from the Gram matrix of all columns and targets: O(q k) for column number k, but
/// columns of which less than 1e-5 is new are left out.
/// @param gram symmetric; its first q columns are those that may be taken.
/// @param target its column that is explained, q or later.
/// @throws ArgumentError when there are no such columns, or the matrix is not square.
ForwardOrder forward_order_in_gram(const Matrix& gram, Index q, Index target,
                                   const ForwardLimits& limits, const RunContext& context = {});

}  // namespace lacuna
