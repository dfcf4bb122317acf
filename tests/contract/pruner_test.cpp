// SPDX-License-Identifier: MIT

#include "bases/monomials.hpp"
#include "contract/contract.hpp"
#include "lacuna/regression/stages/refiner.hpp"
#include "lacuna/regression/stages/solvers.hpp"
#include "support/one_record.hpp"

namespace lacuna::contract {
namespace {

INSTANTIATE_TEST_SUITE_P(Registry, PrunerContract, ::testing::ValuesIn(stages_of<TermPruner>()),
                         name_of_stage<TermPruner>);
INSTANTIATE_TEST_SUITE_P(Registry, FilterContract, ::testing::ValuesIn(stages_of<TermFilter>()),
                         name_of_stage<TermFilter>);

class EveryPruner : public ::testing::TestWithParam<Stage<TermPruner>> {};

TEST_P(EveryPruner, WorksWithEveryRegressor) {
  const LeastSquaresSystem system = system_over(good_columns(), 0.05);
  for (const Stage<Regressor>& regressor : stages_of<Regressor>()) {
    const PruneResult result = GetParam()->prune(system, 0, system.all_terms(), regressor);
    expect_partition(result, system.all_terms());
    EXPECT_TRUE(contains(result.kept, 1) && contains(result.kept, 4)) << regressor->info().name;
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryPruner, ::testing::ValuesIn(stages_of<TermPruner>()),
                         name_of_stage<TermPruner>);

/// x = cos 2t, y = -2 sin 2t.
Dataset oscillator() {
  Trajectory record;
  record.source = "oscillator";
  record.time = Vector::LinSpaced(400, 0.0, 7.98);
  record.states.resize(400, 2);
  record.states.col(0) = (2.0 * record.time.array()).cos();
  record.states.col(1) = -2.0 * (2.0 * record.time.array()).sin();
  return support::one_record({{"x", ""}, {"y", ""}}, {}, record);
}

OdeModel nearly_right(const Dataset& data) {
  const Variables variables{{"x", "y"}, {}};
  return OdeModel(
      data.states, {},
      {{{Term::parse("y", variables), 0.97}}, {{Term::parse("x", variables), -3.9}}});
}

class EveryRefiner : public testing::TestWithParam<StageVariant> {};

TEST_P(EveryRefiner, GivesTheRightModelOrLeavesItAsItIs) {
  const Dataset data = oscillator();
  const OdeModel start = nearly_right(data);
  const TermLibrary library = Monomials{{.max_degree = 1}}.library({{"x", "y"}, {}});
  const RefinedModel refined = stage_of<Refiner>(GetParam())->refine({data, library, start});
  if (!refined.usable) {
    EXPECT_EQ(to_text(refined.model), to_text(start));
    return;
  }
  EXPECT_NEAR(refined.model.coefficient(0, "y"), 1.0, 1e-5);
  EXPECT_NEAR(refined.model.coefficient(1, "x"), -4.0, 1e-5);
  EXPECT_EQ(refined.misfit.size(), 2U);
}

TEST_P(EveryRefiner, RefusesAModelOfOtherStates) {
  const Dataset data = oscillator();
  const TermLibrary library = Monomials{{.max_degree = 1}}.library({{"x", "y"}, {}});
  const OdeModel other({{"a", ""}, {"b", ""}}, {}, {{}, {}});
  EXPECT_THROW(stage_of<Refiner>(GetParam())->refine({data, library, other}), ArgumentError);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryRefiner, testing::ValuesIn(available(Refiner::kKind)),
                         test_name);

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
