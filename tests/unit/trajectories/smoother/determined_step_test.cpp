// SPDX-License-Identifier: MIT
#include "trajectories/smoother/determined_step.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

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
