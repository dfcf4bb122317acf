// SPDX-License-Identifier: MIT
#include "lacuna/solvers/l1/l1_ceres.hpp"

#include <gtest/gtest.h>

#include "lacuna/solvers/l1/l1_coordinate_descent.hpp"
#include "support/l1_problems.hpp"

namespace lacuna {
namespace {

class CeresL1Agreement : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(CeresL1Agreement, FindsTheOptimumOfCoordinateDescent) {
  const L1Problem problem = testing::random_l1_problem(GetParam());
  if (!CeresL1::unavailable().empty()) {
    EXPECT_THROW(CeresL1().solve(problem), ConfigError);
    return;
  }
  const L1Solution reference = CoordinateDescent().solve(problem);
  const L1Solution solution = CeresL1().solve(problem);
  EXPECT_TRUE(solution.converged);
  EXPECT_LE(testing::relative_difference(reference.coefficients, solution.coefficients), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Random, CeresL1Agreement, ::testing::Range<std::uint64_t>(1, 101));

TEST(CeresL1Test, HandlesTargetAndColumnsOfZeros) {
  if (!CeresL1::unavailable().empty()) return;
  L1Problem problem{Matrix::Identity(2, 2), Vector::Zero(2), Vector::Ones(2), Vector::Zero(2)};
  EXPECT_EQ(CeresL1().solve(problem).coefficients.norm(), 0.0);
  problem.triangle(1, 1) = 0.0;
  problem.target << 2.0, 0.0;
  const L1Solution solution = CeresL1().solve(problem);
  EXPECT_NEAR(solution.coefficients[0], 1.5, 1e-9);
  EXPECT_NEAR(solution.coefficients[1], 0.0, 1e-9);
}

TEST(CeresL1Test, CanBeStopped) {
  if (!CeresL1::unavailable().empty()) return;
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  EXPECT_THROW(CeresL1().solve(testing::random_l1_problem(1), context), Cancelled);
}

}  // namespace
}  // namespace lacuna
