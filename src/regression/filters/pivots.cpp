// SPDX-License-Identifier: MIT
#include "regression/filters/pivots.hpp"

#include <algorithm>

namespace lacuna {

TermSet pivots(Matrix rows) {
  // A decision: how near to the largest remaining norm a column must be to be taken for its place
  // in the order.
  constexpr double kFractionOfLargestNorm = 0.5;
  TermSet chosen;
  for (Index step = 0; step < rows.rows(); ++step) {
    const Vector norms = rows.colwise().norm().transpose();
    const double bound = kFractionOfLargestNorm * norms.maxCoeff();
    Index pivot = 0;
    while (norms[pivot] < bound) ++pivot;
    chosen.push_back(pivot);
    const Vector direction = rows.col(pivot) / norms[pivot];
    // Once is enough: rows are orthonormal, so that some column of norm 1/sqrt(n) is left and
    // nothing cancels.
    rows -= direction * (direction.transpose() * rows);
    rows.col(pivot).setZero();
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace lacuna
