// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/secant_slopes.hpp"

#include <algorithm>

namespace lacuna {
namespace {

/// Rows first, first + 1, ... of a result.
void add_slopes(Rates& rates, const Eigen::Ref<const Matrix>& slots,
                const Eigen::Ref<const Vector>& length, const Vector& accuracy, Index first,
                SecantSlopes& result) {
  const Index m = rates.dimension(), rows = slots.rows();
  Program::Block block = rates.block(rows);
  Matrix point = slots;
  Matrix above(rows, m), below(rows, m);
  auto here = result.rates.middleRows(first, rows);
  rates.rate(point, block, here);
  Program::SlotSet changed = 0;
  for (Index k = 0; k < m; ++k) {
    changed |= Program::slot_set(k);
    const Vector reach =
        (0.5 * here.col(k).cwiseAbs().cwiseProduct(length)).cwiseMax(accuracy[k]);
    point.col(k) = slots.col(k) + reach;
    rates.rate_changed(point, changed, block, above);
    point.col(k) = slots.col(k) - reach;
    changed = Program::slot_set(k);
    rates.rate_changed(point, changed, block, below);
    point.col(k) = slots.col(k);
    for (Index row = 0; row < rows; ++row) {
      const double inverse = 0.5 * (1.0 / reach[row]);
      for (Index j = 0; j < m; ++j)
        result.slopes(j + m * k, first + row) = inverse * (above(row, j) - below(row, j));
    }
  }
}

}  // namespace

SecantSlopes secant_slopes(Rates& rates, const Eigen::Ref<const Matrix>& slots,
                           const Eigen::Ref<const Vector>& length, const Vector& accuracy) {
  const Index m = rates.dimension();
  SecantSlopes result{Matrix(m * m, slots.rows()), Matrix(slots.rows(), m)};
  for (Index first = 0; first < slots.rows(); first += Program::kBlockRows) {
    const Index rows = std::min(Program::kBlockRows, slots.rows() - first);
    add_slopes(rates, slots.middleRows(first, rows), length.segment(first, rows), accuracy,
               first, result);
  }
  return result;
}

}  // namespace lacuna
