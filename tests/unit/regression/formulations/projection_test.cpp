// SPDX-License-Identifier: MIT
#include "regression/formulations/projection.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

Trajectory uneven(Index n) {
  Random random(3);
  Trajectory record = oscillation(n);
  for (Index i = 0; i < n; ++i) record.time[i] += 0.006 * random.uniform(-0.5, 0.5);
  record.states << (2.0 * record.time.array()).sin(), 2.0 * (2.0 * record.time.array()).cos();
  return record;
}

TEST(TestFunction, SlopeIsTheDerivativeAndBothVanishOutside) {
  const TestFunction phi{0.7, 4};
  const double h = 1e-6;
  for (const double t : {-0.5, 0.0, 0.3, 0.65})
    EXPECT_NEAR(phi.slope(t), (phi.value(t + h) - phi.value(t - h)) / (2 * h), 1e-8);
  EXPECT_EQ(phi.value(0.7), 0.0);
  EXPECT_EQ(phi.slope(-0.71), 0.0);
}

TEST(QuadratureWeights, IntegrateCubicsExactlyOnAnyGrid) {
  const Vector t = uneven(50).time;
  const Vector w = quadrature_weights(t);
  const double a = t[0], b = t[49];
  EXPECT_NEAR(w.dot(t.array().cube().matrix()), (std::pow(b, 4) - std::pow(a, 4)) / 4, 1e-14);
  EXPECT_NEAR(quadrature_weights(t.head(2)).sum(), t[1] - t[0], 1e-15);
}

TEST(WeakProjection, RowsHoldWithoutADerivative) {
  for (const bool uniform : {true, false}) {
    const Trajectory record = uniform ? oscillation(300) : uneven(300);
    const Projection rows = weak_projection(record, {0.2, 6}, 0.05);
    EXPECT_GT(rows.rows(), 40);
    // dx/dt = v.
    const Vector left = rows.values * record.states.col(1);
    const Vector right = rows.rates * record.states.col(0);
    EXPECT_LT((left - right).cwiseAbs().maxCoeff(),
              (uniform ? 1e-5 : 1e-4) * left.cwiseAbs().maxCoeff());
  }
}

TEST(Projection, CovarianceIsThatOfTheRowsUnderNoiseOfTheSamples) {
  // Rows of dq/dt = q^2 + 3 q v: what noise on q and v does to them, by differences.
  const Trajectory record = uneven(60);
  const Projection rows = weak_projection(record, {0.1, 4}, 0.05);
  const auto left = [&](const Matrix& x) {
    const Vector f = x.col(0).array().square() + 3.0 * x.col(0).array() * x.col(1).array();
    return Vector(rows.values * f - rows.rates * x.col(0));
  };
  constexpr double kReach = 1e-6;
  const Vector noise = Vector{{0.1, 0.4}};
  Matrix response(rows.rows(), 120);
  for (Index j = 0; j < 120; ++j) {
    Matrix above = record.states, below = record.states;
    above.data()[j] += kReach;
    below.data()[j] -= kReach;
    response.col(j) = noise[j / 60] * (left(above) - left(below)) / (2.0 * kReach);
  }
  Matrix sensitivity(60, 2);
  sensitivity.col(0) = 2.0 * record.states.col(0) + 3.0 * record.states.col(1);
  sensitivity.col(1) = 3.0 * record.states.col(0);
  const Matrix expected = response * response.transpose();
  const Matrix found = rows.covariance(0, rows.rows(), sensitivity, noise, 0);
  EXPECT_LT((found - expected).norm(), 1e-7 * expected.norm());
  const Matrix part = rows.covariance(1, 2, sensitivity, noise, 0);
  EXPECT_LT((part - found.block(1, 1, 2, 2)).norm(), 1e-12);
}

TEST(IntegralProjection, RowsAreChangesOfTheState) {
  const Trajectory record = uneven(100);
  const Projection rows = integral_projection(record, 10, 5);
  EXPECT_EQ(rows.rows(), 18);
  EXPECT_LT((rows.values * record.states.col(1) - rows.rates * record.states.col(0)).norm(),
            1e-5);
}

TEST(Projection, CovarianceIsThatOfSimulatedNoise) {
  const Trajectory record = oscillation(60);
  const Projection rows = weak_projection(record, {0.15, 4}, 0.08);
  const Index count = rows.rows();
  Matrix sensitivity(60, 2);
  sensitivity << record.states.col(1), Vector::Constant(60, -4.0);
  const Vector sigma = Eigen::Vector2d(0.1, 0.2);
  Matrix sum = Matrix::Zero(count, count);
  Random random(7);
  constexpr int kDraws = 20000;
  for (int draw = 0; draw < kDraws; ++draw) {
    Matrix noise(60, 2);
    for (Index i = 0; i < noise.size(); ++i) noise.data()[i] = random.normal();
    noise.col(0) *= sigma[0];
    noise.col(1) *= sigma[1];
    const Vector residual = rows.values * sensitivity.cwiseProduct(noise).rowwise().sum() -
                            rows.rates * noise.col(0);
    sum += residual * residual.transpose() / kDraws;
  }
  const Matrix expected = rows.covariance(0, count, sensitivity, sigma, 0);
  EXPECT_LT((sum - expected).norm(), 0.05 * expected.norm());
}

TEST(Projection, TargetFactorMakesRowsWhite) {
  const Projection rows = weak_projection(oscillation(200), {0.15, 4}, 0.07);
  const Matrix factor(rows.target_factor(0, rows.rows()));
  const Matrix covariance = rows.covariance(0, rows.rows(), {}, Vector::Ones(1), 0);
  EXPECT_LT((factor * factor.transpose() - covariance).norm(), 1e-8 * covariance.norm());
}

}  // namespace
}  // namespace lacuna
