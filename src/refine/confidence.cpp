// SPDX-License-Identifier: MIT
#include "confidence.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/numerics/interval.hpp"

namespace lacuna {

Matrix intervals95(const Vector& values, const Vector& standard_errors, double freedom) {
  Matrix ends(values.size(), 2);
  const Vector half = student_quantile_975(freedom) * standard_errors;
  ends.col(0) = values - half;
  ends.col(1) = values + half;
  return ends;
}

double robust_factor(const Matrix& residuals, double huber) {
  const auto n = static_cast<double>(residuals.size());
  double psi2 = 0.0, slope = 0.0, weight = 0.0;
  for (Index i = 0; i < residuals.size(); ++i) {
    const double size = std::abs(residuals.data()[i]);
    psi2 += std::pow(std::min(size, huber), 2);
    slope += size <= huber ? 1.0 : 0.0;
    weight += size <= huber ? 1.0 : huber / size;
  }
  return slope > 0.0 ? (psi2 / n) * (weight / n) / std::pow(slope / n, 2) : 1.0;
}

}  // namespace lacuna
