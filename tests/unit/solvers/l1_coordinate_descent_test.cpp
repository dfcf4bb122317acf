// SPDX-License-Identifier: MIT
#include "lacuna/solvers/l1/l1_coordinate_descent.hpp"

#include <gtest/gtest.h>

#include "solvers/l1/l1_optimality.hpp"
#include "support/l1_problems.hpp"

namespace lacuna {
namespace {

TEST(CoordinateDescent, ReachesTheOptimumOf100RandomProblems) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const L1Problem problem = testing::random_l1_problem(seed);
    const L1Solution solution = CoordinateDescent().solve(problem);
    EXPECT_TRUE(solution.converged) << seed;
    EXPECT_LE(l1_violation(problem, solution.coefficients), 1e-13) << seed;
  }
}

TEST(CoordinateDescent, SoftThresholdsOrthogonalColumns) {
  L1Problem problem{Matrix::Identity(3, 3), Vector(3), Vector::Constant(3, 2.0),
                    Vector::Zero(3)};
  problem.target << 3.0, -0.5, -2.5;
  const L1Solution solution = CoordinateDescent().solve(problem);
  EXPECT_TRUE(solution.coefficients.isApprox(Eigen::Vector3d(2.0, 0.0, -1.5), 1e-14));
}

TEST(CoordinateDescent, LeavesColumnsOfZerosAtZero) {
  L1Problem problem{Matrix::Identity(2, 2), Vector::Ones(2), Vector::Constant(2, 0.2),
                    Vector::Ones(2)};
  problem.triangle(1, 1) = 0.0;
  const L1Solution solution = CoordinateDescent().solve(problem);
  EXPECT_TRUE(solution.converged);
  EXPECT_NEAR(solution.coefficients[0], 0.9, 1e-14);
  EXPECT_EQ(solution.coefficients[1], 0.0);
}

TEST(CoordinateDescent, NeedsFewSweepsHoweverIllConditioned) {
  for (const double condition : {1e2, 1e4, 1e6}) {
    L1Problem problem = testing::random_l1_problem(32);
    Random random(5);
    const Matrix a = testing::ill_conditioned(random, problem.target.size(), condition);
    problem.triangle = a.householderQr().matrixQR().triangularView<Eigen::Upper>();
    const L1Solution solution = CoordinateDescent().solve(problem);
    EXPECT_TRUE(solution.converged) << condition;
    EXPECT_LE(solution.iterations, 50) << condition;
  }
}

TEST(CoordinateDescent, SaysWhenSweepsRunOut) {
  L1Problem problem = testing::random_l1_problem(32);
  problem.start.setZero();
  CoordinateDescentOptions options;
  options.max_sweeps = 1;
  EXPECT_FALSE(CoordinateDescent(options).solve(problem).converged);
}

}  // namespace
}  // namespace lacuna
