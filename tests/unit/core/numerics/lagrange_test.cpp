// SPDX-License-Identifier: MIT
#include "core/numerics/lagrange.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

const Vector kUneven{{0.0, 0.3, 0.5, 1.1, 1.3, 2.0, 2.2, 3.0, 3.1, 4.0}};

double polynomial(double t, Index degree) {
  double value = 0.0;
  for (Index i = 0; i <= degree; ++i)
    value += std::pow(t - 1.5, static_cast<double>(i)) / static_cast<double>(i + 1);
  return value;
}

double cube(double t) { return polynomial(t, 3); }

Matrix samples_of(Index degree) {
  Matrix values(kUneven.size(), 2);
  for (Index i = 0; i < kUneven.size(); ++i)
    values.row(i) << polynomial(kUneven[i], degree), kUneven[i];
  return values;
}

TEST(LagrangeWindow, IsTheOneOfTheSourceForRk4) {
  const LagrangeWindow window = LagrangeWindow::driving(4);
  EXPECT_EQ(window.points, 4);
  EXPECT_EQ(window.before, 2);  // t_{n-2} .. t_{n+1}
}

TEST(LagrangeInterpolant, IsExactForPolynomialsOfItsDegree) {
  for (const int points : {2, 4, 5, 8}) {
    const Matrix values = samples_of(points - 1);
    LagrangeInterpolant interpolant(kUneven, values, LagrangeWindow::driving(points));
    for (double t = 0.0; t <= 4.0; t += 0.07) {
      double out[2];
      interpolant.select(interpolant.interval_of(t));
      interpolant.evaluate(t, out);
      EXPECT_NEAR(out[0], polynomial(t, points - 1), 1e-11) << points << " points, t = " << t;
      EXPECT_NEAR(out[1], t, 1e-13);
    }
  }
}

TEST(LagrangeInterpolant, GoesThroughTheSamples) {
  const Matrix values = samples_of(9);
  LagrangeInterpolant interpolant(kUneven, values, LagrangeWindow::centred(4));
  ASSERT_GT(kUneven.size(), 0);
  for (Index i = 0; i < kUneven.size(); ++i) {
    double out[2];
    interpolant.select(interpolant.interval_of(kUneven[i]));
    interpolant.evaluate(kUneven[i], out);
    EXPECT_EQ(out[0], values(i, 0));
  }
}

TEST(LagrangeInterpolant, UsesTheSelectedSamples) {
  Matrix values = samples_of(3);
  values(7, 0) += 100.0;  // outside of the window t_1 .. t_4 of interval 3
  LagrangeInterpolant interpolant(kUneven, values, LagrangeWindow::driving(4));
  double out[2];
  interpolant.select(3);
  interpolant.evaluate(1.2, out);
  EXPECT_NEAR(out[0], cube(1.2), 1e-12);
  interpolant.select(6);
  interpolant.evaluate(2.5, out);
  EXPECT_GT(std::abs(out[0] - cube(2.5)), 1.0);
}

TEST(LagrangeInterpolant, FindsIntervals) {
  const Matrix values = samples_of(1);
  const LagrangeInterpolant interpolant(kUneven, values, LagrangeWindow::centred(2));
  EXPECT_EQ(interpolant.interval_of(-1.0), 0);
  EXPECT_EQ(interpolant.interval_of(0.4), 1);
  EXPECT_EQ(interpolant.interval_of(0.5), 2);
  EXPECT_EQ(interpolant.interval_of(9.0), 9);
}

}  // namespace
}  // namespace lacuna
