// SPDX-License-Identifier: MIT
#include "data/derivatives/wiener_path.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "data/derivatives/kalman.hpp"
#include "data/derivatives/smoothing_spline.hpp"
#include "grids.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// Covariance at s and t of the signal and of its rate at s with the signal at t, for d^m x/dt^m
/// white from 0 on: integrals of (s - u)_+^(m-1-a) (t - u)_+^(m-1) by the midpoint rule.
double wiener_covariance(double s, double t, int m, int a) {
  const double end = std::min(s, t);
  constexpr int kPoints = 4000;
  double sum = 0.0, scale = 1.0;
  for (int k = 2; k < m; ++k) scale *= k;
  double scale_a = 1.0;
  for (int k = 2; k < m - a; ++k) scale_a *= k;
  for (int p = 0; p < kPoints; ++p) {
    const double u = end * (p + 0.5) / kPoints;
    sum += std::pow(s - u, m - 1 - a) * std::pow(t - u, m - 1);
  }
  return sum * end / kPoints / (scale * scale_a);
}

/// Best linear unbiased prediction of the derivative a with polynomials below degree m as
/// unknown means, from joint covariances.
Vector predicted(const Vector& time, const Vector& y, int m, double lambda, int a) {
  const Index n = time.size();
  Matrix covariance(n, n), cross(n, n), means(n, m), mean_rates(n, m);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      covariance(i, j) = wiener_covariance(time[i], time[j], m, 0) / lambda + (i == j);
      cross(i, j) = wiener_covariance(time[i], time[j], m, a) / lambda;
    }
    for (int p = 0; p < m; ++p) {
      means(i, p) = std::pow(time[i], p);
      mean_rates(i, p) = a == 0 ? means(i, p) : p == 0 ? 0.0 : p * std::pow(time[i], p - 1);
    }
  }
  const Matrix inverse = covariance.inverse();
  const Matrix normal = means.transpose() * inverse * means;
  const Vector beta = normal.inverse() * (means.transpose() * inverse * y);
  return mean_rates * beta + cross * (inverse * (y - means * beta));
}

Vector noisy_wave(const Vector& time) {
  Random random(4);
  Vector y = (3.0 * time.array()).sin();
  for (Index i = 0; i < y.size(); ++i) y[i] += 0.1 * random.normal();
  return y;
}

TEST(WienerPath, IsTheJointGaussiansMeanOnAnyGrid) {
  for (const Vector& grid : {uniform_grid(18, 2.0), jittered_grid(18, 2.0)})
    for (int m = 2; m <= 4; ++m) {
      const Vector time = grid.array() - grid[0];
      const Vector y = noisy_wave(time);
      const double lambda = 0.01;
      const WienerPath path = smooth_wiener(time, y, m, lambda);
      ASSERT_EQ(path.states.size(), static_cast<std::size_t>(m));
      for (int a = 0; a < 2; ++a) {
        const Vector expected = predicted(time, y, m, lambda, a);
        EXPECT_LT((path.states[static_cast<std::size_t>(a)].col(0) - expected).norm(),
                  1e-4 * expected.norm())
            << m << a;
      }
    }
}

TEST(WienerPath, DeviationsAreThoseOfManyDraws) {
  const Vector time = uniform_grid(40, 4.0);
  Random random(6);
  constexpr int kDraws = 2000;
  // Noise alone: the estimate varies by less than the deviation, which has the path's share too,
  // by S S' against S of the same smoother. Checked through sums over all samples.
  Matrix noise(40, kDraws);
  for (Index j = 0; j < kDraws; ++j)
    for (Index i = 0; i < 40; ++i) noise(i, j) = random.normal();
  const WienerPath path = smooth_wiener(time, noise, 3, 1e-3);
  const Matrix covariance = path.states[0] * noise.transpose() / kDraws;  // S, as noise is white
  EXPECT_LT((covariance.diagonal() - path.deviations[0].cwiseAbs2()).cwiseAbs().maxCoeff(), 0.06);
}

TEST(WienerPath, ScoreIsLeastNearTheLambdaOfTheProcess) {
  Random random(12);
  const Index n = 3000;
  Vector y(n);
  double x = 0.0, v = 0.0;
  for (Index i = 0; i < n; ++i) {  // d^2x/dt^2 white of intensity 0.01, steps of 1
    const double a = 0.1 * random.normal(), b = 0.1 * random.normal();
    x += v + 0.5 * a + b / std::sqrt(12.0);
    v += a;
    y[i] = x + random.normal();
  }
  const Vector time = Vector::LinSpaced(n, 0.0, static_cast<double>(n - 1));
  const double at = wiener_score(time, y, 2, 100.0);
  EXPECT_LT(at, wiener_score(time, y, 2, 25.0));
  EXPECT_LT(at, wiener_score(time, y, 2, 400.0));
  EXPECT_LT(at, wiener_score(time, y, 3, 1e6));
  EXPECT_NEAR(smooth_wiener(time, y, 2, 100.0).noise[0], 1.0, 0.05);
}

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
    EXPECT_LT((kalman.differentiate(time, y, k) - expected).norm(), 1e-5 * expected.norm())
        << k;
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
