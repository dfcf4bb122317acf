// SPDX-License-Identifier: MIT

#include "bases/monomials.hpp"
#include "contract/contract.hpp"
#include "lacuna/regression/stages/refiner.hpp"
#include "lacuna/regression/stages/solvers.hpp"
#include "solvers/ols.hpp"
#include "support/one_record.hpp"

namespace lacuna::contract {
namespace {

class EveryPruner : public testing::TestWithParam<StageVariant> {
 protected:
  PruneResult prune(const LeastSquaresSystem& system, const TermSet& active) const {
    return stage_of<TermPruner>(GetParam())->prune(system, 0, active, Ols{});
  }
};

bool contains(const TermSet& terms, Index term) {
  return std::find(terms.begin(), terms.end(), term) != terms.end();
}

TEST_P(EveryPruner, KeepsTheTrueTerms) {
  for (const double noise : {0.0, 0.05}) {
    const LeastSquaresSystem system = system_over(good_columns(), noise);
    const PruneResult result = prune(system, system.all_terms());
    expect_partition(result, system.all_terms());
    EXPECT_TRUE(contains(result.kept, 1) && contains(result.kept, 4)) << "noise " << noise;
  }
}

TEST_P(EveryPruner, ChoosesFromTheActiveTermsOnly) {
  const LeastSquaresSystem system = good_system();
  const TermSet active = {1, 2, 4};
  expect_partition(prune(system, active), active);
}

TEST_P(EveryPruner, NothingIsChosenFromNothing) {
  const PruneResult result = prune(good_system(), {});
  EXPECT_TRUE(result.kept.empty());
  EXPECT_TRUE(result.removed.empty());
}

TEST_P(EveryPruner, WorksWithEveryRegressor) {
  const LeastSquaresSystem system = system_over(good_columns(), 0.05);
  for (const StageVariant& variant : available(Regressor::kKind)) {
    const auto pruner = stage_of<TermPruner>(GetParam());
    const auto regressor = stage_of<Regressor>(variant);
    const PruneResult result = pruner->prune(system, 0, system.all_terms(), *regressor);
    expect_partition(result, system.all_terms());
    EXPECT_TRUE(contains(result.kept, 1) && contains(result.kept, 4)) << variant.label;
  }
}

TEST_P(EveryPruner, RefusesATargetThatIsNotThere) {
  const LeastSquaresSystem system = good_system();
  const auto pruner = stage_of<TermPruner>(GetParam());
  EXPECT_THROW(pruner->prune(system, 1, system.all_terms(), Ols{}), ArgumentError);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryPruner, testing::ValuesIn(available(TermPruner::kKind)),
                         test_name);

class EveryFilter : public testing::TestWithParam<StageVariant> {
 protected:
  FilterResult filter(const LeastSquaresSystem& system) const {
    return stage_of<TermFilter>(GetParam())->filter(system);
  }
};

TEST_P(EveryFilter, KeepsEveryTermOfAGoodProblem) {
  const LeastSquaresSystem system = good_system();
  const FilterResult result = filter(system);
  EXPECT_EQ(result.kept, system.all_terms());
  EXPECT_TRUE(result.removed.empty());
}

TEST_P(EveryFilter, RemovesColumnsOfZeros) {
  Matrix theta = good_columns();
  theta.col(3).setZero();
  const LeastSquaresSystem system = system_over(theta);
  const FilterResult result = filter(system);
  expect_partition(result, system.all_terms());
  ASSERT_EQ(result.removed.size(), 1u);
  EXPECT_EQ(result.removed[0].term, 3);
}

TEST_P(EveryFilter, PartitionsDependentTerms) {
  Matrix theta(kRows, kTerms + 1);
  theta << good_columns(), good_columns().col(0) + 2.0 * good_columns().col(1);
  const LeastSquaresSystem system = system_over(theta);
  const FilterResult result = filter(system);
  expect_partition(result, system.all_terms());
  EXPECT_LE(result.removed.size(), 1u);
}

TEST_P(EveryFilter, ThreadsDoNotChangeTheResult) {
  EXPECT_EQ(filter(system_over(good_columns(), 0.1, 1)).kept,
            filter(system_over(good_columns(), 0.1, 2)).kept);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryFilter, testing::ValuesIn(available(TermFilter::kKind)),
                         test_name);

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
