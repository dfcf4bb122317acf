// SPDX-License-Identifier: MIT
// L1 solvers of libraries that a build may lack.
#include <gtest/gtest.h>

#include "lacuna/solvers/l1/l1_ceres.hpp"
#include "lacuna/solvers/l1/l1_coordinate_descent.hpp"
#include "lacuna/solvers/l1/l1_nlopt.hpp"
#include "support/l1_problems.hpp"

namespace lacuna {
namespace {

template <class Solver>
class OptionalL1Solver : public ::testing::Test {
 protected:
  /// Whether this build lacks the solver, which then says so when it is asked.
  bool is_absent() const {
    if (Solver::unavailable().empty()) return false;
    EXPECT_THROW(Solver().solve(testing::random_l1_problem(1)), ConfigError);
    return true;
  }
};

using OptionalL1Solvers = ::testing::Types<CeresL1, NloptL1>;
TYPED_TEST_SUITE(OptionalL1Solver, OptionalL1Solvers);

TYPED_TEST(OptionalL1Solver, FindsTheOptimumOfCoordinateDescent) {
  if (this->is_absent()) return;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const L1Problem problem = testing::random_l1_problem(seed);
    const L1Solution reference = CoordinateDescent().solve(problem);
    const L1Solution solution = TypeParam().solve(problem);
    EXPECT_TRUE(solution.converged) << seed;
    EXPECT_LE(testing::relative_difference(reference.coefficients, solution.coefficients), 1e-6)
        << seed;
  }
}

TYPED_TEST(OptionalL1Solver, HandlesTargetAndColumnsOfZeros) {
  if (this->is_absent()) return;
  L1Problem problem{Matrix::Identity(2, 2), Vector::Zero(2), Vector::Ones(2), Vector::Zero(2)};
  EXPECT_EQ(TypeParam().solve(problem).coefficients.norm(), 0.0);
  problem.triangle(1, 1) = 0.0;
  problem.target << 2.0, 0.0;
  const L1Solution solution = TypeParam().solve(problem);
  EXPECT_NEAR(solution.coefficients[0], 1.5, 1e-9);
  EXPECT_NEAR(solution.coefficients[1], 0.0, 1e-9);
}

TYPED_TEST(OptionalL1Solver, CanBeStopped) {
  if (this->is_absent()) return;
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  EXPECT_THROW(TypeParam().solve(testing::random_l1_problem(1), context), Cancelled);
}

}  // namespace
}  // namespace lacuna
