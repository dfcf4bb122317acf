// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/linear_step.hpp"

#include <gtest/gtest.h>

#include <array>

namespace lacuna {
namespace {

/// Runge and Kutta's step of order 4 for x' = J x + b, stage by stage.
Vector step_by_stages(const std::array<Matrix, 3>& j, const std::array<Vector, 3>& b,
                      const Vector& x, double h) {
  const Vector k1 = j[0] * x + b[0];
  const Vector k2 = j[1] * (x + 0.5 * h * k1) + b[1];
  const Vector k3 = j[1] * (x + 0.5 * h * k2) + b[1];
  const Vector k4 = j[2] * (x + h * k3) + b[2];
  return x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

TEST(LinearStep, MapsAreThoseOfTheStages) {
  for (const Index m : {1, 2, 3, 5, 9}) {
    std::array<Matrix, 3> j;
    std::array<Vector, 3> b;
    Matrix jacobians(m * m, 3);
    for (std::size_t node = 0; node < 3; ++node) {
      j[node] = Matrix::Random(m, m);
      b[node] = Vector::Random(m);
      jacobians.col(static_cast<Index>(node)) = j[node].reshaped();
    }
    const Vector x = Vector::Random(m);
    LinearStep step;
    step.compute(jacobians, m, 0.3);
    const Vector found =
        step.whole * x + step.first * b[0] + step.middle * b[1] + step.last * b[2];
    EXPECT_LT((found - step_by_stages(j, b, x, 0.3)).norm(), 1e-14) << m;
  }
}

}  // namespace
}  // namespace lacuna
