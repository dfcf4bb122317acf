// SPDX-License-Identifier: MIT
#include "solvers/l1/l1_optimality.hpp"

#include <gtest/gtest.h>

#include "support/l1_problems.hpp"

namespace lacuna {
namespace {

/// min (3 - z0)^2 + (1 - z1)^2 + 2 |z0| + 4 |z1| has its minimum at (2, 0).
L1Problem small_problem() {
  L1Problem problem{Matrix::Identity(2, 2), Vector(2), Vector(2), Vector::Zero(2)};
  problem.target << 3.0, 1.0;
  problem.penalty << 2.0, 4.0;
  return problem;
}

TEST(L1Violation, IsZeroAtTheOptimumOnly) {
  EXPECT_EQ(l1_violation(small_problem(), Eigen::Vector2d(2.0, 0.0)), 0.0);
  EXPECT_GT(l1_violation(small_problem(), Eigen::Vector2d(2.1, 0.0)), 1e-2);
  EXPECT_GT(l1_violation(small_problem(), Eigen::Vector2d(2.0, 0.1)), 1e-2);
  EXPECT_GT(l1_violation(small_problem(), Eigen::Vector2d(-2.0, 0.0)), 1e-2);
}

TEST(L1Polished, SolvesExactlyOnTheNonzeroCoefficients) {
  const auto z = l1_polished(small_problem(), Eigen::Vector2d(1.7, 1e-6));
  ASSERT_TRUE(z.has_value());
  EXPECT_TRUE(z->isApprox(Eigen::Vector2d(2.0, 0.0), 1e-15));
}

TEST(L1Polished, RefusesAWrongSignPattern) {
  EXPECT_FALSE(l1_polished(small_problem(), Eigen::Vector2d(-1.7, 0.0)).has_value());
  EXPECT_FALSE(l1_polished(small_problem(), Eigen::Vector2d(0.0, 1.0)).has_value());
}

TEST(L1FaceMinimum, StopsCoefficientsAtZeroAndGoesOnWithTheOthers) {
  L1Problem problem{Matrix::Identity(2, 2), Vector(2), Vector(2), Vector::Zero(2)};
  problem.target << 3.0, -1.0;
  problem.penalty << 2.0, 0.5;
  const Vector z = l1_face_minimum(problem, Eigen::Vector2d(1.0, 0.5));
  EXPECT_TRUE(z.isApprox(Eigen::Vector2d(2.0, 0.0), 1e-15)) << z.transpose();
  const Vector stays = l1_face_minimum(problem, Eigen::Vector2d(0.0, -0.1));
  EXPECT_TRUE(stays.isApprox(Eigen::Vector2d(0.0, -0.75), 1e-15)) << stays.transpose();
}

TEST(L1FaceMinimum, KeepsThePointWhereColumnsAreDependent) {
  L1Problem problem{Matrix::Zero(2, 2), Vector::Ones(2), Vector::Ones(2), Vector::Zero(2)};
  problem.triangle.row(0).setOnes();
  const Vector z = Eigen::Vector2d(0.3, 0.4);
  EXPECT_EQ(l1_face_minimum(problem, z), z);
}

TEST(L1Finished, KeepsThePointWhereItCannotBePolished) {
  const Vector z = Eigen::Vector2d(-1.7, 0.0);
  const L1Solution solution = l1_finished(small_problem(), z, 3, 1e-12);
  EXPECT_FALSE(solution.converged);
  EXPECT_EQ(solution.coefficients, z);
  EXPECT_EQ(solution.iterations, 3);
}

}  // namespace
}  // namespace lacuna
