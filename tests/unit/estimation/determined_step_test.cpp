// SPDX-License-Identifier: MIT
#include "estimation/determined_step.hpp"

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
  const DeterminedStep step =
      determined_step(problem.normal, problem.right, Vector::Ones(2), 3.0);
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
      determined_step(problem.normal, problem.right, Vector{{2.0, 5.0}}, 3.0);
  ASSERT_EQ(step.held.cols(), 1);
  EXPECT_NEAR(step.held(0, 0), -step.held(1, 0), 1e-9) << "their ratio is held";
  // Both take half of the relative change of the product.
  EXPECT_NEAR(step.change[0] / 2.0, 0.05, 1e-9);
  EXPECT_NEAR(step.change[1] / 5.0, 0.05, 1e-9);
  const Vector ratio{{2.0, -5.0}};
  EXPECT_NEAR((step.covariance * ratio.cwiseInverse()).norm(), 0.0, 1e-9);
}

TEST(DeterminedStep, RelativeChangesHaveTheSignsOfTheCoefficients) {
  // The product of b = -2 and c = 5 is what equations tell: they grow alike or not at all.
  const Matrix rows = 100.0 * Matrix::Identity(2, 2);
  const Problem problem = problem_of(rows, rows * Vector{{-0.4, 0.0}});
  Matrix unseen(2, 1);
  unseen << std::sqrt(0.5), -std::sqrt(0.5);
  const DeterminedStep step =
      determined_step(problem.normal, problem.right, Vector{{-2.0, 5.0}}, 3.0, unseen);
  ASSERT_EQ(step.held.cols(), 1);
  EXPECT_LT(step.change[0], 0.0);
  EXPECT_NEAR(step.change[0] / -2.0, step.change[1] / 5.0, 1e-12);
}

TEST(DeterminedStep, HoldsWhatItIsToldToHold) {
  const Matrix rows = 100.0 * Matrix::Identity(2, 2);
  const Problem problem = problem_of(rows, rows * Vector{{0.2, 0.0}});
  Matrix unseen(2, 1);
  unseen << std::sqrt(0.5), -std::sqrt(0.5);
  const DeterminedStep step =
      determined_step(problem.normal, problem.right, Vector::Ones(2), 3.0, unseen);
  ASSERT_EQ(step.held.cols(), 1);
  EXPECT_NEAR(step.change[0], 0.1, 1e-12);
  EXPECT_NEAR(step.change[1], 0.1, 1e-12);
}

TEST(DeterminedStep, UnknownsWithoutASizeMayBeAnything) {
  // Nothing but the difference is seen; the second has no size, so that the first is held.
  Matrix rows(2, 2);
  rows << 1, -1, 2, -2;
  const Problem problem = problem_of(100.0 * rows, 100.0 * rows * Vector{{0.4, 0.0}});
  const DeterminedStep step =
      determined_step(problem.normal, problem.right, Vector{{1.0, 0.0}}, 3.0);
  ASSERT_EQ(step.held.cols(), 1);
  EXPECT_NEAR(step.change[0], 0.0, 1e-12);
  EXPECT_NEAR(step.change[1], -0.4, 1e-12);
}

}  // namespace
}  // namespace lacuna
