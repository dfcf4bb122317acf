// SPDX-License-Identifier: MIT
#include "core/numerics/serial_correlation.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {

SerialCorrelation serial_correlation(const Vector& residuals) {
  constexpr double kWindow = 5.0;
  const Index n = residuals.size();
  const double square = residuals.squaredNorm();
  SerialCorrelation result;
  if (!(square > 0.0) || !std::isfinite(square)) return result;
  double sum = 0.0;
  while (result.reach < n / 4 && static_cast<double>(result.reach) < kWindow * result.time) {
    const Index pairs = n - ++result.reach;
    const double rho = residuals.head(pairs).dot(residuals.tail(pairs)) / square;
    sum += rho * rho - 1.0 / static_cast<double>(n);
    result.time = std::max(1.0, 1.0 + 2.0 * sum);
  }
  return result;
}

}  // namespace lacuna
