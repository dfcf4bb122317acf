// SPDX-License-Identifier: MIT
// Rows [A y] whose columns have a lot in common.
#pragma once

#include <Eigen/QR>

#include "core/base/random.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

inline Matrix triangle_of(const Matrix& rows) {
  return Eigen::HouseholderQR<Matrix>(rows)
      .matrixQR()
      .topRows(rows.cols())
      .triangularView<Eigen::Upper>();
}

/// 400 rows of 12 columns that have a lot in common; y = 2 a_1 - 3 a_4 + a_9 + noise.
inline Matrix correlated_rows(double noise) {
  Random random(11);
  Matrix rows(400, 13);
  for (Index i = 0; i < 400; ++i) {
    const double common = random.normal();
    for (Index j = 0; j < 12; ++j) rows(i, j) = 3.0 * common + random.normal();
    rows(i, 12) = 2.0 * rows(i, 1) - 3.0 * rows(i, 4) + rows(i, 9) + noise * random.normal();
  }
  return rows;
}

}  // namespace lacuna
