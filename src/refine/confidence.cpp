// SPDX-License-Identifier: MIT
#include "confidence.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {

double student_quantile_975(double freedom) {
  constexpr double z = 1.959963984540054;
  constexpr double z2 = z * z;
  const double n = std::max(freedom, 1.0);
  const double g1 = z * (z2 + 1.0) / 4.0;
  const double g2 = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double g3 = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  const double g4 =
      z * ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
  return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

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
