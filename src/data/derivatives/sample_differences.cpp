// SPDX-License-Identifier: MIT
#include "data/derivatives/sample_differences.hpp"

#include <vector>

#include "core/base/check.hpp"
#include "data/derivatives/stencil.hpp"

namespace lacuna {

SparseRows divided_differences(const Vector& time, int order) {
  check_argument(order >= 1 && time.size() > order, "divided_differences",
                 "there are not more times than the order");
  check_times(time, 1, "divided_differences");
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index i = 0; i + order < time.size(); ++i) {
    const Vector weights = interpolation_weights(
        (time.segment(i, order + 1).array() - time[i]).matrix(), 0.0, order);
    for (Index j = 0; j <= order; ++j) entries.emplace_back(i, i + j, weights[j]);
  }
  SparseRows rows(time.size() - order, time.size());
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

Matrix smooth_differences(const Vector& time, const Matrix& values, int order) {
  if (order == 0) return values;
  const StencilRule rule{"differences of smoothed samples", order, 2 + (order - 1) / 2,
                         4 + order, [order](const Vector& nodes, double at) {
                           return interpolation_weights(nodes, at, order);
                         }};
  return apply_stencil(rule, time, values);
}

}  // namespace lacuna
