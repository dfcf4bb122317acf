// SPDX-License-Identifier: MIT
#include "data/derivatives/uniform_spline.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(UniformSpline, FunctionsAddUpToOneAndTheirDerivativesToZero) {
  const Vector time = Vector::LinSpaced(23, 1.0, 4.0);
  const UniformSpline spline = spline_over(Vector::LinSpaced(9, 1.0, 4.0), 5);
  EXPECT_EQ(spline.functions(), 13);
  for (int k = 0; k <= 3; ++k) {
    const Vector sums = spline_rows(spline, time, k) * Vector::Ones(13);
    EXPECT_LT((sums.array() - (k == 0 ? 1.0 : 0.0)).abs().maxCoeff(), 1e-9) << k;
  }
}

TEST(UniformSpline, DerivativesAreThoseOfTheFunctions) {
  const UniformSpline spline{0.0, 0.5, 6, 5};
  const Vector time = Vector::LinSpaced(17, 0.1, 2.85);
  constexpr double kStep = 1e-4;
  for (int k = 1; k <= 3; ++k) {
    const Matrix right = spline_rows(spline, time.array() + kStep, k - 1);
    const Matrix left = spline_rows(spline, time.array() - kStep, k - 1);
    const Matrix numeric = (right - left) / (2.0 * kStep);
    EXPECT_LT((Matrix(spline_rows(spline, time, k)) - numeric).cwiseAbs().maxCoeff(), 1e-4) << k;
  }
}

TEST(UniformSpline, CubicHasTheKnownValuesAtAKnot) {
  const Matrix rows = spline_rows({0.0, 1.0, 3, 3}, Vector::Constant(1, 1.0), 0);
  EXPECT_NEAR(rows(0, 1), 1.0 / 6.0, 1e-14);  // de Boor: 1/6, 4/6, 1/6
  EXPECT_NEAR(rows(0, 2), 4.0 / 6.0, 1e-14);
  EXPECT_NEAR(rows(0, 3), 1.0 / 6.0, 1e-14);
}

TEST(UniformSpline, PenaltyIsTheIntegralOfTheSquare) {
  const UniformSpline spline{-1.0, 0.4, 5, 5};
  const Vector c = Vector::LinSpaced(10, -1.0, 2.0).array().sin();
  constexpr Index kPoints = 20000;  // midpoints
  const double step = 2.0 / kPoints;
  const Vector at = Vector::LinSpaced(kPoints, -1.0 + 0.5 * step, 1.0 - 0.5 * step);
  for (int m = 2; m <= 4; ++m) {
    const double integral = (spline_rows(spline, at, m) * c).squaredNorm() * step;
    EXPECT_NEAR(c.dot(spline_penalty(spline, m) * c), integral, 1e-6 * integral) << m;
  }
}

}  // namespace
}  // namespace lacuna
