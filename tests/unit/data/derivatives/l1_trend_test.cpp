// SPDX-License-Identifier: MIT
#include "data/derivatives/l1_trend.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "core/base/random.hpp"
#include "data/derivatives/sample_differences.hpp"
#include "grids.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(L1Trend, TwoSamplesComeNearerByTheWeight) {
  const SparseRows difference = divided_differences(Vector::LinSpaced(2, 0.0, 1.0), 1);
  const L1Trend apart = l1_trend(difference, Vector{{1.0, 5.0}}, 2.0);
  EXPECT_NEAR(apart.values[0], 2.0, 1e-6);
  EXPECT_NEAR(apart.values[1], 4.0, 1e-6);
  EXPECT_EQ(apart.knots, 1);
  const L1Trend joined = l1_trend(difference, Vector{{1.0, 5.0}}, 10.0);
  EXPECT_NEAR(joined.values[0], 3.0, 1e-6);
  EXPECT_NEAR(joined.values[1], 3.0, 1e-6);
  EXPECT_EQ(joined.knots, 0);
}

/// y - z = D'v with |v| <= weight / 2, and v at its bound, with the sign of D z, where that is not
/// 0: the conditions of a minimum, v by dense least squares.
TEST(L1Trend, HasASubgradientOfZero) {
  Random random(3);
  for (const int order : {1, 2, 3, 4})
    for (const double weight : {0.1, 1.0, 30.0}) {
      const Vector time = jittered_grid(80, 79.0);
      const SparseRows rows = divided_differences(time, order);
      Vector y = (0.1 * time.array()).sin();
      for (Index i = 0; i < y.size(); ++i) y[i] += 0.1 * random.normal();
      const L1Trend trend = l1_trend(rows, y, weight);
      const Matrix dense = Matrix(rows).transpose();
      const Vector v = dense.colPivHouseholderQr().solve(y - trend.values);
      EXPECT_LT((dense * v - (y - trend.values)).norm(), 1e-8 * y.norm()) << order;
      EXPECT_LT(v.cwiseAbs().maxCoeff(), 0.5 * weight * (1.0 + 1e-6)) << order;
      const Vector u = rows * trend.values;
      Index knots = 0;
      for (Index i = 0; i < u.size(); ++i) {
        if (std::abs(u[i]) < 1e-3 * u.cwiseAbs().maxCoeff()) continue;
        ++knots;
        EXPECT_NEAR(v[i], std::copysign(0.5 * weight, u[i]), 0.01 * weight) << order;
      }
      EXPECT_GE(trend.knots, knots) << order << " " << weight;
    }
}

}  // namespace
}  // namespace lacuna
