// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lacuna/regression/pruners/cross_validation.hpp"
#include "lacuna/regression/pruners/information_criterion.hpp"
#include "lacuna/regression/pruners/sequential_thresholding.hpp"
#include "lacuna/solvers/ols.hpp"
#include "regression/pruners/elimination.hpp"
#include "support/pruner_checks.hpp"
#include "support/sparse_problem.hpp"

namespace lacuna {
namespace {

using Criterion = InformationCriterionOptions::Criterion;
using testing::rossler_10000;

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

class EliminationTest : public ::testing::Test {
 protected:
  const LeastSquaresSystem system_ = testing::sparse_problem(200, 0.1, 0.0);
  const Ols ols_ = Ols();
  const RunContext context_ = {};
  const Elimination full_{system_, 0, system_.all_terms(), ols_, context_};
};

/// Of one elimination, and of another one that begins with the terms it has left.
void expect_losses_of_a_fresh_one(const LeastSquaresSystem& system) {
  const Ols ols;
  const RunContext context;
  for (Elimination state(system, 0, system.all_terms(), ols, context); state.size() > 0;
       state = state.without({smallest(state.losses())})) {
    const Vector fresh =
        Elimination(system, 0, state.active(), ols, context).losses();
    EXPECT_LT((state.losses() - fresh).cwiseQuotient(fresh).cwiseAbs().maxCoeff(), 1e-8)
        << state.size();
  }
}

TEST_F(EliminationTest, LossesDoNotDriftWhileTermsLeave) {
  expect_losses_of_a_fresh_one(testing::sparse_problem(200, 0.1, 0.0));
  Matrix theta = Matrix::Random(300, 24);  // near one another, and very near
  for (Index j = 12; j < 24; ++j)
    theta.col(j) = theta.col(j - 12) + (j < 20 ? 1e-2 : 1e-4) * theta.col(j);
  expect_losses_of_a_fresh_one({make_row_source(theta, Matrix::Random(300, 1)),
                                std::vector<std::string>(24), {"y"}});
}

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

TEST(SequentialThresholding, FindsRosslersTermsHoweverWritten) {
  const Matrix noisy = testing::with_noise(rossler_10000().derivatives, 1e-4, 3);
  testing::expect_rossler_terms(SequentialThresholding(), rossler_10000().derivatives, 3);
  for (const auto& r : testing::rewritings())
    testing::expect_rossler_terms(SequentialThresholding(), noisy, 3, r);
}

TEST(SequentialThresholding, KeptTermsAreAboveTheThresholdAndRemovedOnesWereBelow) {
  const auto& data = rossler_10000();
  const auto system =
      testing::monomial_system(data.states, testing::with_noise(data.derivatives, 0.1, 3), 2);
  const SequentialThresholding pruner({.threshold = 0.3});
  const PruneResult result = pruner.prune(system, 2, system.all_terms(), Ols());
  const Regression fit = Ols().fit(system, system.subproblem(2, result.kept));
  for (const auto& [name, fraction] :
       testing::fractions(system, 2, fit.active, fit.coefficients, {"same"}))
    EXPECT_GE(std::abs(fraction), 0.3) << name;
  EXPECT_FALSE(result.removed.empty());
  for (const Removal& gone : result.removed) EXPECT_LT(gone.value, 0.3);
}

TEST(SequentialThresholding, SurvivesOddProblems) {
  testing::expect_survives_odd_problems(SequentialThresholding());
}

}  // namespace
}  // namespace lacuna
