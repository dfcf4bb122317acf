// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/kalman.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "grids.hpp"
#include "lacuna/data/derivatives/smoothing_spline.hpp"

namespace lacuna {
namespace {

Matrix two_waves(const Vector& time, double noise, std::uint64_t seed) {
  Random random(seed);
  Matrix y(time.size(), 2);
  y << time.array().sin().matrix(), time.array().cos().matrix();
  for (Index i = 0; i < y.rows(); ++i)
    for (Index k = 0; k < 2; ++k) y(i, k) += noise * random.normal();
  return y;
}

TEST(KalmanSmoother, IsTheSplineOfTheSameLambda) {
  const Vector time = uniform_grid(150, 8.0);
  const Matrix y = two_waves(time, 0.05, 1);
  const KalmanSmoother kalman{{.order = 3, .lambda = 1e-3}};
  const SmoothingSpline spline{{.order = 3, .lambda = 1e-3}};
  for (int k = 0; k <= 2; ++k) {
    const Matrix expected = spline.differentiate(time, y, k);
    EXPECT_LT((kalman.differentiate(time, y, k) - expected).norm(), 1e-5 * expected.norm()) << k;
  }
}

TEST(KalmanSmoother, StandardErrorsCoverTheTruthOnAnyGrid) {
  const Vector time = jittered_grid(400, 15.0);
  double squares = 0.0, error = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Matrix y = two_waves(time, 0.1, seed);
    const Vector off =
        KalmanSmoother{}.differentiate(time, y).col(0) - time.array().cos().matrix();
    const Matrix claimed = *KalmanSmoother{}.standard_error(time, y);
    squares += off.cwiseQuotient(claimed.col(0)).squaredNorm() / 2000.0;
    error += off.squaredNorm() / 2000.0;
  }
  EXPECT_LT(std::sqrt(error), 0.12);
  EXPECT_GT(squares, 0.2);
  EXPECT_LT(squares, 2.0);
}

TEST(KalmanSmoother, SmoothSignalsHaveAHighOrderAndRoughOnesALowOne) {
  const auto order_for = [](const Vector& time, const Vector& y) {
    Dataset data;
    data.states = {{"x", ""}};
    data.trajectories.push_back({"", time, y, Matrix(time.size(), 0), Matrix()});
    const auto fitted = fitted_to(Stage<Differentiator>(KalmanSmoother{}), data);
    return *dynamic_cast<const KalmanSmoother&>(*fitted).options().order;
  };
  const Vector time = uniform_grid(600, 60.0);
  EXPECT_EQ(order_for(time, two_waves(time, 0.01, 1).col(0)), 4);
  Random random(3);
  Vector rough(600);
  double x = 0.0, v = 0.0;
  for (Index i = 0; i < 600; ++i) {  // an integrated random walk: order 2
    v += random.normal();
    x += 0.1 * v;
    rough[i] = x;
  }
  EXPECT_EQ(order_for(time, rough), 2);
}

TEST(KalmanSmoother, LambdaNeedsItsOrderAndDerivativesEndBelowIt) {
  EXPECT_THROW(KalmanSmoother({.lambda = 1.0}), ConfigError);
  const Vector time = uniform_grid(30, 1.0);
  EXPECT_THROW(KalmanSmoother({.order = 2, .lambda = 1.0}).differentiate(time, Matrix(time), 2),
               ArgumentError);
}

}  // namespace
}  // namespace lacuna
