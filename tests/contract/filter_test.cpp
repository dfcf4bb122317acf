// SPDX-License-Identifier: MIT
#include "contract/contract.hpp"
#include "lacuna/regression/stages/term_filter.hpp"

namespace lacuna::contract {
namespace {

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

}  // namespace
}  // namespace lacuna::contract
