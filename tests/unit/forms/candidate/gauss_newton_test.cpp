// SPDX-License-Identifier: MIT
#include "forms/candidate/gauss_newton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna {
namespace {

TEST(GaussNewton, FindsTheShapeOfACurveToTheLastDigitsInFewEvaluations) {
  const Vector t = Vector::LinSpaced(50, 0.0, 1.0);
  int evaluations = 0;
  const auto left = [&](const Vector& p) -> Vector {
    ++evaluations;
    return (p[1] * (-5.0 * p[0] * t.array()).exp() - 0.7 * (-5.0 * 0.3 * t.array()).exp())
        .matrix();
  };
  const CubeMinimum found = gauss_newton(left, Vector{{0.5, 0.5}});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.point[0], 0.3, 1e-9);
  EXPECT_NEAR(found.point[1], 0.7, 1e-9);
  EXPECT_LT(evaluations, 40);
}

TEST(GaussNewton, FindsTheLeastOfWhatLeavesResiduals) {
  // (p - 1/4)^2 + 1/4 (p - 1)^2 is least where 5 p = 2.
  const auto left = [](const Vector& p) {
    return Vector{{p[0] - 0.25, 0.5 * (p[0] - 1.0)}};
  };
  const CubeMinimum found = gauss_newton(left, Vector::Constant(1, 0.9));
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.point[0], 0.4, 1e-5);
  EXPECT_NEAR(found.squares, 0.15 * 0.15 + 0.3 * 0.3, 1e-9);
}

TEST(GaussNewton, StaysInTheCubeAndEndsOnItsFaces) {
  double least = 1.0, most = 0.0;
  const auto left = [&](const Vector& p) {
    least = std::min(least, p.minCoeff());
    most = std::max(most, p.maxCoeff());
    return Vector{{p[0] + 0.5, p[1] - 0.5, 2.0 * (p[2] - 1.5)}};
  };
  const CubeMinimum found = gauss_newton(left, Vector{{0.4, 0.99, 1.0 + 1e-15}});
  EXPECT_TRUE(found.converged);
  EXPECT_LT((found.point - Vector{{0.0, 0.5, 1.0}}).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GE(least, 0.0);
  EXPECT_LE(most, 1.0);
}

TEST(GaussNewton, NoStepIsLongerThanItsReach) {
  Vector before = Vector::Constant(1, 0.05);
  double longest = 0.0;
  const auto left = [&](const Vector& p) {
    longest = std::max(longest, (p - before).cwiseAbs().maxCoeff());
    before = p;
    return Vector{{p[0] - 0.95}};
  };
  EXPECT_NEAR(gauss_newton(left, before, {.reach = 0.1}).point[0], 0.95, 1e-9);
  EXPECT_LT(longest, 0.1 + 1e-5);
}

TEST(GaussNewton, SaysWhereItDoesNotConverge) {
  const auto jump = [](const Vector& p) { return Vector{{p[0] < 0.3 ? 2.0 : 1.0}}; };
  const CubeMinimum flat = gauss_newton(jump, Vector::Constant(1, 0.1));
  EXPECT_FALSE(flat.converged);
  EXPECT_EQ(flat.point[0], 0.1);
  const auto one = [](const Vector& p) { return Vector{{p[0] + p[1] - 0.3, 1.0}}; };
  EXPECT_FALSE(gauss_newton(one, Vector{{0.2, 0.4}}).converged);  // the sum alone counts
  const auto nowhere = [](const Vector& p) {
    return Vector::Constant(p.size(), std::numeric_limits<double>::quiet_NaN()).eval();
  };
  const CubeMinimum none = gauss_newton(nowhere, Vector::Constant(1, 0.5));
  EXPECT_FALSE(none.converged);
  EXPECT_EQ(none.point[0], 0.5);
}

TEST(GaussNewton, EndsWhereWhatIsWantedIsFarAndStepsGainLittle) {
  int evaluations = 0;
  // |r|^2 is least at p = 1/2, where 4 is left; each step there gains less than half.
  const auto left = [&](const Vector& p) {
    ++evaluations;
    return Vector{{p[0] - 0.5, 2.0}};
  };
  const Vector start = Vector::Constant(1, 0.1);
  const CubeMinimum far = gauss_newton(left, start, {.wanted = 0.9});
  EXPECT_FALSE(far.converged);
  EXPECT_EQ(far.point[0], 0.1);
  EXPECT_EQ(evaluations, 2);
  const CubeMinimum near = gauss_newton(left, start, {.wanted = 1.1});
  EXPECT_TRUE(near.converged);
  EXPECT_NEAR(near.point[0], 0.5, 1e-6);
  // A step that halves what is there is taken, however far that is.
  const auto steep = [](const Vector& p) { return Vector{{9.0 * (p[0] - 0.5), 2.0}}; };
  EXPECT_NEAR(gauss_newton(steep, start, {.reach = 1.0, .wanted = 0.1}).point[0], 0.5, 1e-6);
}

TEST(GaussNewton, IsNeverWorseThanItsStart) {
  const auto ragged = [](const Vector& p) {
    return Vector{{std::sin(40.0 * p[0]), p[0] - 0.5}};
  };
  for (double start = 0.0; start <= 1.0; start += 0.125) {
    const Vector at = Vector::Constant(1, start);
    EXPECT_LE(gauss_newton(ragged, at).squares, ragged(at).squaredNorm());
  }
}

}  // namespace
}  // namespace lacuna
