// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/criterion/criterion.hpp"

#include "contract/contract.hpp"

namespace lacuna::contract {
namespace {

class EveryCriterion : public testing::TestWithParam<StageVariant> {};

TEST_P(EveryCriterion, ParametersAndChoicesAreNeverAGain) {
  const auto criterion = stage_of<Criterion>(GetParam());
  double last = 0.0;
  for (double parameters = 0.0; parameters < 20.0; ++parameters) {
    const double penalty = criterion->penalty({0.0, parameters, 500.0, 0.0});
    EXPECT_GE(penalty, last);
    EXPECT_GE(criterion->penalty({0.0, parameters, 500.0, 3.0}), penalty);
    last = penalty;
  }
}

TEST_P(EveryCriterion, IsLinearInTheDeviance) {
  const auto criterion = stage_of<Criterion>(GetParam());
  const double first = criterion->value({-100.0, 4.0, 500.0, 1.0});
  EXPECT_NEAR(criterion->value({50.0, 4.0, 500.0, 1.0}) - first, 150.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryCriterion,
                         testing::ValuesIn(available(Criterion::kKind)), test_name);

}  // namespace
}  // namespace lacuna::contract
