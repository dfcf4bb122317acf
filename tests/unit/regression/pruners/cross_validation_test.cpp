// SPDX-License-Identifier: MIT
#include "lacuna/regression/pruners/cross_validation.hpp"

#include <gtest/gtest.h>

#include "lacuna/regression/pruners/information_criterion.hpp"
#include "support/pruner_checks.hpp"
#include "support/sparse_problem.hpp"

namespace lacuna {
namespace {

using testing::rossler_10000;
using Criterion = InformationCriterionOptions::Criterion;

/// Draws in which a pruner keeps exactly the true terms.
int exact_draws(const TermPruner& pruner, double memory) {
  int exact = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto system = testing::sparse_series(2000, 2.0, memory, seed);
    if (pruner.prune(system, 0, system.all_terms(), Ols()).kept == TermSet{1, 4, 7}) ++exact;
  }
  return exact;
}

TEST(CrossValidation, FindsRosslersTermsFromExactDerivatives) {
  ASSERT_FALSE(testing::rewritings().empty());
  for (const auto& r : testing::rewritings())
    testing::expect_rossler_terms(CrossValidation(), rossler_10000().derivatives, 3, r);
}

TEST(CrossValidation, FindsTheSparseSetInWhiteNoise) {
  EXPECT_GE(exact_draws(CrossValidation(), 0.0), 14);
}

TEST(CrossValidation, CorrelatedResidualsBringNoTerms) {
  const int by_rows = exact_draws(InformationCriterion(), 0.9);
  const int by_effective_rows =
      exact_draws(InformationCriterion({.criterion = Criterion::EffectiveBic}), 0.9);
  const int by_blocks = exact_draws(CrossValidation(), 0.9);
  EXPECT_LE(by_rows, 5);
  EXPECT_GE(by_effective_rows, 16);
  EXPECT_GE(by_blocks, 14);
}

TEST(CrossValidation, WithoutAllowanceKeepsAtLeastAsMuch) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto system = testing::sparse_series(500, 2.0, 0.5, seed);
    const TermSet few = CrossValidation().prune(system, 0, system.all_terms(), Ols()).kept;
    const TermSet more = CrossValidation({.standard_errors = 0.0})
                             .prune(system, 0, system.all_terms(), Ols())
                             .kept;
    EXPECT_LE(few.size(), more.size());
  }
}

TEST(CrossValidation, TellsThePredictionErrorOfEveryTermThatLeft) {
  const auto system = testing::sparse_series(500, 2.0, 0.0, 1);
  const PruneResult result = CrossValidation().prune(system, 0, system.all_terms(), Ols());
  ASSERT_FALSE(result.removed.empty());
  for (const Removal& removal : result.removed)
    EXPECT_GE(removal.value, removal.threshold) << removal.term;
}

TEST(CrossValidation, SurvivesOddProblems) {
  testing::expect_survives_odd_problems(CrossValidation());
}

}  // namespace
}  // namespace lacuna
