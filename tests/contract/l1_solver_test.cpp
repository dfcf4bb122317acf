// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/l1_solver.hpp"

#include "contract/contract.hpp"

namespace lacuna::contract {
namespace {

class EveryL1Solver : public testing::TestWithParam<StageVariant> {
 protected:
  L1Solution solve(const L1Problem& problem) const {
    return stage_of<L1Solver>(GetParam())->solve(problem);
  }
};

L1Problem diagonal_problem(double penalty) {
  L1Problem problem;
  problem.triangle = Vector(Eigen::Vector3d(1.0, 2.0, 0.5)).asDiagonal();
  problem.target = Eigen::Vector3d(3.0, -1.0, 0.25);
  problem.penalty = Vector::Constant(3, penalty);
  problem.start = Vector::Zero(3);
  return problem;
}

TEST_P(EveryL1Solver, WithoutPenaltyIsLeastSquares) {
  const L1Solution solution = solve(diagonal_problem(0.0));
  EXPECT_TRUE(solution.converged);
  EXPECT_LT((solution.coefficients - Eigen::Vector3d(3.0, -0.5, 0.5)).norm(), 1e-7);
}

/// For a diagonal R the optimum is the soft threshold: z = S(c r, p / 2) / r^2.
TEST_P(EveryL1Solver, ShrinksAndZeroesByTheSoftThreshold) {
  const L1Solution solution = solve(diagonal_problem(0.5));
  EXPECT_TRUE(solution.converged);
  EXPECT_NEAR(solution.coefficients[0], 3.0 - 0.25, 1e-7);
  EXPECT_NEAR(solution.coefficients[1], -(2.0 - 0.25) / 4.0, 1e-7);
  EXPECT_NEAR(solution.coefficients[2], 0.0, 1e-7);
}

TEST_P(EveryL1Solver, AHighPenaltyLeavesNothing) {
  EXPECT_LT(solve(diagonal_problem(100.0)).coefficients.norm(), 1e-7);
}

TEST_P(EveryL1Solver, RefusesShapesThatDoNotFit) {
  L1Problem problem = diagonal_problem(0.1);
  problem.target.resize(2);
  EXPECT_THROW(solve(problem), ArgumentError);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryL1Solver, testing::ValuesIn(available(L1Solver::kKind)),
                         test_name);

}  // namespace
}  // namespace lacuna::contract
