// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/l1_solver.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/options.hpp"

namespace lacuna {
namespace {

struct EchoOptions {
  static constexpr StageInfo kInfo{"echo", "", ""};
  int surplus = 0;  ///< coefficients too many
  void describe(OptionVisitor& v) { v.field({"surplus", "", ""}, surplus); }
};

class Echo final : public Configured<L1Solver, EchoOptions> {
 public:
  using Configured::Configured;

 private:
  L1Solution do_solve(const L1Problem& problem, const RunContext&) const override {
    return {Vector::Ones(problem.target.size() + options().surplus), 3, true};
  }
};

L1Problem problem_of(Index size) {
  return {Matrix::Identity(size, size), Vector::Ones(size), Vector::Ones(size),
          Vector::Zero(size)};
}

TEST(L1Solver, EmptyProblemIsSolved) {
  const L1Solution solution = Echo{}.solve(problem_of(0));
  EXPECT_EQ(solution.coefficients.size(), 0);
  EXPECT_TRUE(solution.converged);
}

TEST(L1Solver, ShapesAndNumbersAreChecked) {
  L1Problem problem = problem_of(3);
  problem.start.resize(2);
  EXPECT_THROW(Echo{}.solve(problem), ArgumentError);
  problem = problem_of(3);
  problem.penalty[1] = -1.0;
  EXPECT_THROW(Echo{}.solve(problem), ArgumentError);
  problem = problem_of(3);
  problem.target[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Echo{}.solve(problem), ArgumentError);
}

TEST(L1Solver, SolutionMustFitTheProblem) {
  EXPECT_THROW(Echo{{.surplus = 1}}.solve(problem_of(3)), ArgumentError);
}

}  // namespace
}  // namespace lacuna
