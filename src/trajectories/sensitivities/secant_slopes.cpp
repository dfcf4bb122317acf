// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/secant_slopes.hpp"

#include <algorithm>

namespace lacuna {

Matrix secant_slopes(Rates& rates, const Eigen::Ref<const Matrix>& slots,
                     const Eigen::Ref<const Vector>& length, const Vector& accuracy) {
  constexpr Index kRowsAtOnce = 256;  // a fact of the machines: they stay in cache
  const Index m = rates.dimension();
  Matrix result(m * m, slots.rows());
  for (Index first = 0; first < slots.rows(); first += kRowsAtOnce) {
    const Index rows = std::min(kRowsAtOnce, slots.rows() - first);
    Matrix point = slots.middleRows(first, rows);
    Matrix here(rows, m), above(rows, m), below(rows, m);
    rates.rate(point, here);
    for (Index k = 0; k < m; ++k) {
      const Vector reach =
          (0.5 * here.col(k).cwiseAbs().cwiseProduct(length.segment(first, rows)))
              .cwiseMax(accuracy[k]);
      const Vector centre = point.col(k);
      point.col(k) = centre + reach;
      rates.rate(point, above);
      point.col(k) = centre - reach;
      rates.rate(point, below);
      point.col(k) = centre;
      result.block(m * k, first, m, rows) =
          ((0.5 * reach.cwiseInverse()).asDiagonal() * (above - below)).transpose();
    }
  }
  return result;
}

}  // namespace lacuna
