// SPDX-License-Identifier: MIT
#include "lacuna/regression/pruners/information_criterion.hpp"

#include <gtest/gtest.h>

#include "support/pruner_checks.hpp"
#include "support/sparse_problem.hpp"

namespace lacuna {
namespace {

using testing::rossler_10000;

TEST(InformationCriterion, FindsRosslersTermsFromExactDerivatives) {
  ASSERT_FALSE(testing::rewritings().empty());
  for (const auto& r : testing::rewritings())
    testing::expect_rossler_terms(InformationCriterion(), rossler_10000().derivatives, 3, r);
}

TEST(InformationCriterion, BicFindsTheSparseSetAndAiccKeepsAtLeastThat) {
  InformationCriterionOptions aicc;
  aicc.criterion = InformationCriterionOptions::Criterion::Aicc;
  std::size_t exact = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto system = testing::sparse_problem(1000, 0.5, 0.0, seed);
    const TermSet all = system.all_terms();
    const TermSet bic = InformationCriterion().prune(system, 0, all, Ols()).kept;
    const TermSet more = InformationCriterion(aicc).prune(system, 0, all, Ols()).kept;
    EXPECT_TRUE(std::includes(more.begin(), more.end(), bic.begin(), bic.end()));
    if (bic == TermSet{1, 4, 7}) ++exact;
  }
  EXPECT_GE(exact, 16u);
}

TEST(InformationCriterion, AiccNeverTakesAsManyTermsAsRows) {
  InformationCriterionOptions aicc;
  aicc.criterion = InformationCriterionOptions::Criterion::Aicc;
  const auto system = testing::sparse_problem(11, 0.1, 0.0);
  EXPECT_LT(InformationCriterion(aicc).prune(system, 0, system.all_terms(), Ols()).kept.size(),
            10u);
}

TEST(InformationCriterion, SurvivesOddProblems) {
  testing::expect_survives_odd_problems(InformationCriterion());
}

}  // namespace
}  // namespace lacuna
