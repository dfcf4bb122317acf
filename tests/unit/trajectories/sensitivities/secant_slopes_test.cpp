// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/secant_slopes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

/// v' = -2 v - 3 sign(v), with t.
Rates rubbing() {
  const Variables variables{{"v"}, {}};
  return Rates(OdeModel(
      {{"v", ""}}, {},
      {{{Term::parse("v", variables), -2.0}, {Term::parse("sign(v)", variables), -3.0}}}));
}

TEST(SecantSlopes, AreDerivativesWhereTheModelIsSmooth) {
  const Variables variables{{"x", "y"}, {}};
  Rates rates(OdeModel(
      {{"x", ""}, {"y", ""}}, {},
      {{{Term::parse("x*y", variables), 1.0}}, {{Term::parse("sin(x)", variables), -2.0}}}));
  Matrix slots(300, 3);
  slots.col(0) = Vector::LinSpaced(300, -1.0, 1.0);
  slots.col(1).setConstant(0.7);
  slots.col(2).setZero();
  const auto [slopes, f] =
      secant_slopes(rates, slots, Vector::Zero(300), Vector::Constant(2, 1e-5));
  Matrix expected(300, 2);
  rates.rate(slots, expected);
  EXPECT_EQ(f, expected);
  for (Index i = 0; i < 300; ++i) {
    EXPECT_NEAR(slopes(0, i), 0.7, 1e-9);
    EXPECT_NEAR(slopes(1, i), -2.0 * std::cos(slots(i, 0)), 1e-9);
    EXPECT_NEAR(slopes(2, i), slots(i, 0), 1e-9);
    EXPECT_NEAR(slopes(3, i), 0.0, 1e-9);
  }
}

TEST(SecantSlopes, AJumpActsAsOnAverageOverTheReach) {
  Rates rates = rubbing();
  Matrix slots(2, 2);
  slots << 0.01, 0.0, 0.5, 0.0;
  const Matrix slopes =
      secant_slopes(rates, slots, Vector::Constant(2, 0.1), Vector::Constant(1, 1e-6)).slopes;
  const double reach = 0.5 * 0.1 * (2.0 * 0.01 + 3.0);
  EXPECT_NEAR(slopes(0, 0), -2.0 - 2.0 * 3.0 / (2.0 * reach), 1e-9) << "the jump is in reach";
  EXPECT_NEAR(slopes(0, 1), -2.0, 1e-9) << "and here it is not";
}

TEST(SecantSlopes, TheAccuracyIsTheLeastReach) {
  Rates rates = rubbing();
  Matrix slots(1, 2);
  slots << 0.01, 0.0;
  const Matrix slopes =
      secant_slopes(rates, slots, Vector::Zero(1), Vector::Constant(1, 0.05)).slopes;
  EXPECT_NEAR(slopes(0, 0), -2.0 - 3.0 / 0.05, 1e-9);
}

}  // namespace
}  // namespace lacuna
