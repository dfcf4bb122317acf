// SPDX-License-Identifier: MIT
#include "confidence.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/core/statistics/interval.hpp"

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

std::optional<Matrix> block_covariance(const std::vector<Matrix>& windows,
                                       const Matrix& inverse) {
  const Index p = inverse.cols(), count = static_cast<Index>(windows.size());
  const Index blocks = std::min(count, std::max(kCovarianceBlocks, 2 * p));
  if (p == 0 || count < 2 * p) return std::nullopt;
  Matrix gradients = Matrix::Zero(p, blocks);
  for (Index w = 0; w < count; ++w) {
    const Matrix& r = windows[static_cast<std::size_t>(w)];
    const auto lower = r.bottomRightCorner(p + 1, p + 1);
    gradients.col(w * blocks / count) += lower.leftCols(p).transpose() * lower.col(p);
  }
  const double correction =
      static_cast<double>(blocks) / static_cast<double>(std::max<Index>(1, blocks - p));
  return correction * inverse * (gradients * gradients.transpose()) * inverse;
}

}  // namespace lacuna
