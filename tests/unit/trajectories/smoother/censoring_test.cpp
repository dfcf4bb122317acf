// SPDX-License-Identifier: MIT
#include "trajectories/smoother/censoring.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "trajectories/smoother/determined_step.hpp"

namespace lacuna {
namespace {

/// Moments of a standard normal variable about -z of which only what lies above 0 is known, by
/// the trapezoidal rule: probability, mean and variance.
struct Moments {
  double probability = 0.0, mean = 0.0, variance = 0.0;

  explicit Moments(double z) {
    const double h = 1e-4;
    double sums[3] = {0.0, 0.0, 0.0};
    for (double x = 0.0; x < std::max(0.0, z) + 12.0; x += h) {
      const double w = (x == 0.0 ? 0.5 : 1.0) * h * std::exp(-0.5 * (x - z) * (x - z));
      sums[0] += w;
      sums[1] += w * x;
      sums[2] += w * x * x;
    }
    probability = sums[0] / std::sqrt(2.0 * M_PI);
    mean = sums[1] / sums[0];
    variance = sums[2] / sums[0] - mean * mean;
  }
};

TEST(Truncation, HasTheMomentsOfTheTruncatedNormal) {
  for (const double z : {-6.0, -2.0, -0.3, 0.0, 1.0, 4.0}) {
    const Truncation known(z);
    const Moments exact(z);
    EXPECT_NEAR(known.deviance, -2.0 * std::log(exact.probability), 1e-5) << z;
    EXPECT_NEAR(z + known.shift, exact.mean, 1e-5) << z;
    EXPECT_NEAR(1.0 - known.fraction, exact.variance, 1e-5) << z;
  }
}

TEST(Truncation, GoesOnSmoothlyFarBelow) {
  for (const double z : {-25.0, -1e3}) {
    const Truncation here(z * (1.0 - 1e-9)), there(z * (1.0 + 1e-9));
    EXPECT_NEAR(there.deviance / here.deviance, 1.0, 1e-7);
    EXPECT_NEAR(there.shift / here.shift, 1.0, 1e-6);
    EXPECT_NEAR(there.fraction / here.fraction, 1.0, 1e-4);
    EXPECT_LT(here.fraction, 1.0);
  }
}

TEST(Truncation, SaysNothingFarAbove) {
  const Truncation known(40.0);
  EXPECT_EQ(known.deviance, 0.0);
  EXPECT_NEAR(known.fraction, 0.0, 1e-300);
}

/// Moments between two ends by the trapezoidal rule.
Truncation integrated(double low, double high) {
  const int n = 200000;
  const double h = (high - low) / n, middle = 0.5 * (low + high);
  double sums[3] = {};
  for (int i = 0; i <= n; ++i) {
    const double x = low + i * h;
    const double w = (i == 0 || i == n ? 0.5 : 1.0) * h *
                     std::exp(-0.5 * (x * x - middle * middle));
    for (int k = 0; k < 3; ++k) sums[k] += w * std::pow(x, k);
  }
  Truncation exact(0.0);
  exact.deviance = -2.0 * std::log(sums[0]) + middle * middle + std::log(2.0 * M_PI);
  exact.shift = sums[1] / sums[0];
  exact.fraction = 1.0 - (sums[2] / sums[0] - exact.shift * exact.shift);
  return exact;
}

TEST(Truncation, BetweenTwoEndsHasTheMomentsOfTheTruncatedNormal) {
  for (const double low : {-30.0, -9.0, -1.0, -0.2, 0.0, 0.7, 6.0, 24.0, 40.0})
    for (const double width : {0.01, 0.5, 3.0}) {
      const Truncation known(low, low + width), exact = integrated(low, low + width);
      const double far = std::abs(low) > 20.0 ? 1e-2 : 1e-5;  // by a series there
      EXPECT_NEAR(known.deviance, exact.deviance, far * std::abs(exact.deviance) + 1e-5);
      EXPECT_NEAR(known.shift, exact.shift, far * std::max(1.0, std::abs(exact.shift)))
          << low << " " << width;
      EXPECT_NEAR(known.fraction, exact.fraction, far) << low << " " << width;
    }
}

TEST(Truncation, BetweenNarrowEndsIsTheVarianceOfRounding) {
  const double step = 0.1;
  const Truncation known(0.3 - 0.5 * step, 0.3 + 0.5 * step);
  EXPECT_NEAR(1.0 - known.fraction, step * step / 12.0, 1e-5);
}

/// Normal matrix and right side of rows.
struct Problem {
  Matrix normal;
  Vector right;
};

Problem problem_of(const Matrix& rows, const Vector& values) {
  return {rows.transpose() * rows, rows.transpose() * values};
}

TEST(DeterminedStep, IsLeastSquaresWhereAllIsDetermined) {
  Matrix rows(4, 2);
  rows << 1, 2, 3, -1, 0, 1, 2, 2;
  rows *= 100.0;
  const Vector values = rows * Vector{{0.3, -0.2}};
  const Problem problem = problem_of(rows, values);
  const DeterminedStep step = determined_step(problem.normal, problem.right, Vector::Ones(2));
  EXPECT_EQ(step.held.cols(), 0);
  EXPECT_NEAR(step.change[0], 0.3, 1e-12);
  EXPECT_NEAR(step.change[1], -0.2, 1e-12);
  EXPECT_NEAR((step.covariance * problem.normal - Matrix::Identity(2, 2)).norm(), 0.0, 1e-9);
}

TEST(DeterminedStep, HoldsWhatOnlyAProductTells) {
  // The rows see log(b c) with b = 2, c = 5: columns 1/b and 1/c.
  Matrix rows(3, 2);
  rows << 1.0 / 2.0, 1.0 / 5.0, 2.0 / 2.0, 2.0 / 5.0, -1.0 / 2.0, -1.0 / 5.0;
  rows *= 50.0;
  const Vector values = rows.col(0) * 2.0 * 0.1;
  const Problem problem = problem_of(rows, values);
  const DeterminedStep step =
      determined_step(problem.normal, problem.right, Vector{{2.0, 5.0}});
  ASSERT_EQ(step.held.cols(), 1);
  EXPECT_NEAR(step.held(0, 0), -step.held(1, 0), 1e-9) << "their ratio is held";
  // Both take half of the relative change of the product.
  EXPECT_NEAR(step.change[0] / 2.0, 0.05, 1e-9);
  EXPECT_NEAR(step.change[1] / 5.0, 0.05, 1e-9);
  const Vector ratio{{2.0, -5.0}};
  EXPECT_NEAR((step.covariance * ratio.cwiseInverse()).norm(), 0.0, 1e-9);
}

TEST(DeterminedStep, RelativeChangesHaveTheSignsOfTheCoefficients) {
  // The equations tell the product of b = -2 and c = 5 alone: log(-b c), columns 1/b and 1/c.
  // Both take half of a relative change of it by 0.2, so that b falls and c grows.
  const Vector slope{{1.0 / -2.0, 1.0 / 5.0}};
  const Matrix rows = 100.0 * slope.transpose();
  const Problem problem = problem_of(rows, Vector{{100.0 * 0.2}});
  const DeterminedStep step =
      determined_step(problem.normal, problem.right, Vector{{-2.0, 5.0}});
  ASSERT_EQ(step.held.cols(), 1);
  EXPECT_NEAR(step.change[0], -0.2, 1e-12);
  EXPECT_NEAR(step.change[1], 0.5, 1e-12);
}

TEST(DeterminedStep, WhatIsKeptDoesNotMove) {
  // The difference alone is seen: with the second kept the first takes all of it.
  Matrix rows(2, 2);
  rows << 1, -1, 2, -2;
  const Problem problem = problem_of(100.0 * rows, 100.0 * rows * Vector{{0.0, -0.4}});
  const DeterminedStep step =
      determined_step(problem.normal, problem.right, Vector::Ones(2), {1});
  EXPECT_EQ(step.held.cols(), 0) << "kept is not held by what the records do not determine";
  EXPECT_NEAR(step.change[0], 0.4, 1e-12);
  EXPECT_EQ(step.change[1], 0.0);
  EXPECT_EQ(step.covariance(1, 1), 0.0);
  // One column of squared length 100^2 (1 + 4).
  EXPECT_NEAR(step.covariance(0, 0), 1.0 / 50000.0, 1e-15);
}

TEST(DeterminedStep, UnknownsWithoutASizeMayBeAnything) {
  // Nothing but the difference is seen; the second has no size, so that the first is held.
  Matrix rows(2, 2);
  rows << 1, -1, 2, -2;
  const Problem problem = problem_of(100.0 * rows, 100.0 * rows * Vector{{0.4, 0.0}});
  const DeterminedStep step =
      determined_step(problem.normal, problem.right, Vector{{1.0, 0.0}});
  ASSERT_EQ(step.held.cols(), 1);
  EXPECT_NEAR(step.change[0], 0.0, 1e-12);
  EXPECT_NEAR(step.change[1], -0.4, 1e-12);
}

}  // namespace
}  // namespace lacuna
