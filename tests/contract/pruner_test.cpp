// SPDX-License-Identifier: MIT
#include "contract/contract.hpp"
#include "lacuna/regression/stages/term_pruner.hpp"
#include "lacuna/solvers/ols.hpp"

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

}  // namespace
}  // namespace lacuna::contract
