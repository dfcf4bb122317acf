// SPDX-License-Identifier: MIT
#include "core/numerics/coordinate_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

double soft_threshold(double value, double threshold) {
  return std::copysign(std::max(std::abs(value) - threshold, 0.0), value);
}

}  // namespace

double coordinate_sweep(const Matrix& gram, const SweepPenalty& penalty, Vector& z,
                        Vector& slope) {
  double largest = 0.0;
  for (Index j = 0; j < z.size(); ++j) {
    const double curvature = gram(j, j);
    const double next =
        curvature > 0.0 ? soft_threshold(z[j] * curvature + slope[j], 0.5 * penalty.first[j]) /
                              (curvature + 0.5 * penalty.second)
                        : 0.0;
    if (next == z[j]) continue;
    slope -= gram.col(j) * (next - z[j]);
    largest = std::max(largest, std::abs(next - z[j]));
    z[j] = next;
  }
  return largest;
}

}  // namespace lacuna
