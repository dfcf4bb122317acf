// SPDX-License-Identifier: MIT
#include "data/derivatives/stencil.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "grids.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Vector nodes(std::initializer_list<double> values) {
  return Eigen::Map<const Vector>(values.begin(), static_cast<Index>(values.size()));
}

TEST(FitWeights, AreTheTableOfSavitzkyAndGolay) {
  const Vector smooth = fit_weights(nodes({-2, -1, 0, 1, 2}), 0.0, 2, 0);
  EXPECT_LT((35.0 * smooth - nodes({-3, 12, 17, 12, -3})).norm(), 1e-13);
  const Vector rate = fit_weights(nodes({-2, -1, 0, 1, 2}), 0.0, 2, 1);
  EXPECT_LT((10.0 * rate - nodes({-2, -1, 0, 1, 2})).norm(), 1e-13);
}

StencilRule second_order_rule() {
  return {"test", 1, 1, 3,
          [](const Vector& x, double at) { return interpolation_weights(x, at, 1); }};
}

TEST(ApplyStencil, ConstantsGiveExactlyZero) {
  const Vector time = uniform_grid(50, 3.0);
  const Matrix constant = Matrix::Constant(50, 2, 1.0 / 3.0);
  EXPECT_TRUE(apply_stencil(second_order_rule(), time, constant).isZero(0.0));
  EXPECT_TRUE(apply_stencil(second_order_rule(), jittered_grid(50, 3.0), constant).isZero(0.0));
}

TEST(ApplyStencil, RoundedTimeStampsAreUniform) {
  const Index n = 2001;
  const Vector exact = uniform_grid(n, 2.0);
  const Vector rounded = (exact.array() * 1e3 / 1.0000001 * 1e3).round() * 1e-6;
  const Matrix line = exact;
  const Matrix rate = apply_stencil(second_order_rule(), rounded, line);
  // Own weights would show the rounding of single stamps; common ones see the mean step.
  EXPECT_LT((rate.array() - rate.mean()).abs().maxCoeff(), 2e-3);
  EXPECT_LT((rate.middleRows(1, n - 2).array() - rate(1, 0)).abs().maxCoeff(), 1e-10);
}

TEST(ApplyStencil, DriftingClockIsNotUniform) {
  const Index n = 4001;
  const Vector uniform = uniform_grid(n, 4.0);
  const Vector drifting = uniform.array() + 1e-4 * uniform.array().square();
  const Matrix line = drifting;
  const Matrix rate = apply_stencil(second_order_rule(), drifting, line);
  EXPECT_LT((rate.array() - 1.0).abs().maxCoeff(), 1e-9);
}

TEST(ApplyStencil, LeavesOutTheMarginOnAnyGrid) {
  for (const Vector& time : {uniform_grid(40, 0.1), jittered_grid(40, 3.0)}) {
    const Matrix values = time.array().sin().matrix();
    const Matrix all = apply_stencil(second_order_rule(), time, values);
    EXPECT_EQ(apply_stencil(second_order_rule(), time, values, 5), all.middleRows(5, 30));
  }
}

}  // namespace
}  // namespace lacuna
