// SPDX-License-Identifier: MIT
// Pruners.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "regression/pruners/cross_validation.hpp"
#include "regression/pruners/elimination.hpp"
#include "regression/pruners/information_criterion.hpp"
#include "regression/pruners/minor_terms.hpp"
#include "regression/pruners/sequential_thresholding.hpp"
#include "solvers/ols.hpp"
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
    const Vector fresh = Elimination(system, 0, state.active(), ols, context).losses();
    EXPECT_LT((state.losses() - fresh).cwiseQuotient(fresh).cwiseAbs().maxCoeff(), 1e-8)
        << state.size();
  }
}

TEST_F(EliminationTest, LossesDoNotDriftWhileTermsLeave) {
  expect_losses_of_a_fresh_one(testing::sparse_problem(200, 0.1, 0.0));
  Matrix theta = Matrix::Random(300, 24);  // near one another, and very near
  for (Index j = 12; j < 24; ++j)
    theta.col(j) = theta.col(j - 12) + (j < 20 ? 1e-2 : 1e-4) * theta.col(j);
  expect_losses_of_a_fresh_one(
      {make_row_source(theta, Matrix::Random(300, 1)), std::vector<std::string>(24), {"y"}});
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

TEST(MinorTerms, FindsRosslersSevenTermsAndTheirCoefficients) {
  const auto& data = rossler_10000();
  const auto system = testing::monomial_system(data.states, data.derivatives, 3);
  const std::map<std::string, double> truth[3] = {{{"010", -1.0}, {"001", -1.0}},
                                                  {{"100", 1.0}, {"010", 0.2}},
                                                  {{"000", 0.2}, {"001", -5.7}, {"101", 1.0}}};
  for (Index k = 0; k < 3; ++k) {
    const PruneResult result = MinorTerms().prune(system, k, system.all_terms(), Ols());
    const Regression fit = Ols().fit(system, system.subproblem(k, result.kept));
    ASSERT_EQ(fit.active.size(), truth[k].size());
    const auto names = testing::names_of(system, fit.active);
    for (std::size_t i = 0; i < names.size(); ++i)
      EXPECT_NEAR(fit.coefficients[static_cast<Index>(i)], truth[k].at(names[i]), 1e-10);
  }
}

TEST(MinorTerms, FindsThemIn35And56Candidates) {
  testing::expect_rossler_terms(MinorTerms(), rossler_10000().derivatives, 4);
  testing::expect_rossler_terms(MinorTerms(), rossler_10000().derivatives, 5);
}

TEST(MinorTerms, DoesNotDependOnHowDataAreWritten) {
  for (const double noise : {0.0, 1e-3, 1e-2}) {
    const Matrix noisy = testing::with_noise(rossler_10000().derivatives, noise, 3);
    ASSERT_FALSE(testing::rewritings().empty());
    for (const auto& r : testing::rewritings())
      testing::expect_rossler_terms(MinorTerms(), noisy, 3, r);
  }
}

TEST(MinorTerms, SaysWhenAndWhyTermsLeft) {
  const auto& data = rossler_10000();
  const auto system =
      testing::monomial_system(data.states, testing::with_noise(data.derivatives, 1e-3, 3), 2);
  const PruneResult result = MinorTerms().prune(system, 0, system.all_terms(), Ols());
  ASSERT_EQ(result.removed.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(result.removed[i].step, static_cast<int>(i) + 1);
    EXPECT_LT(result.removed[i].value, result.removed[i].threshold);
  }
}

TEST(MinorTerms, LimitsAreThoseOfTheExcessOverTheFullFit) {
  // Orthonormal columns: r_k^2 = e^2 + the squares of the k smallest coefficients.
  const Vector a = (Vector(4) << 1e-3, 2e-3, 1.0, 2.0).finished();
  const double e = 1e-2;
  Matrix theta = Matrix::Identity(5, 4), y(5, 1);
  y << a, e;
  const LeastSquaresSystem system(make_row_source(theta, y), {"p", "q", "r", "s"}, {"y"});
  const MinorTermsOptions options{.stop = MinorTermsOptions::Stop::Jump, .eta = 1e-4};
  const PruneResult result = MinorTerms(options).prune(system, 0, {0, 1, 2, 3}, Ols());
  ASSERT_EQ(result.kept, (TermSet{2, 3}));
  std::vector<double> excess{1e-4 * (2.0 + 1e-4)};
  for (Index k = 1; k <= 4; ++k) excess.push_back(a.head(k).squaredNorm() / (e * e));
  double largest = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    largest = std::max(largest, std::log(excess[k + 1] / excess[k]));
  for (std::size_t k = 0; k < 2; ++k) {
    const double limit = e * std::sqrt(1.0 + excess[k] * std::exp(0.4 * largest));
    EXPECT_NEAR(result.removed[k].threshold, limit, 1e-6 * limit) << k;
  }
}

TEST(MinorTerms, WithoutJumpEveryGrowthBeyondEtaCounts) {
  const auto& data = rossler_10000();
  const auto system =
      testing::monomial_system(data.states, testing::with_noise(data.derivatives, 1e-2, 3), 2);
  MinorTermsOptions options;
  options.jump = 0.0;
  options.eta = 0.05;
  const PruneResult result = MinorTerms(options).prune(system, 2, system.all_terms(), Ols());
  const double full = system.subproblem(2, system.all_terms()).residual_norm();
  const Subproblem kept = system.subproblem(2, result.kept);
  EXPECT_LE(kept.residual_norm(), 1.05 * full);
  for (Index i = 0; i < kept.size(); ++i) {
    Subproblem fewer = kept;
    fewer.remove(i);
    EXPECT_GT(fewer.residual_norm(), 1.05 * full);
  }
}

TEST(MinorTerms, StopsWhereNoiseExplainsNoMore) {
  const auto& data = rossler_10000();
  for (const double noise : {1e-4, 1e-2, 5e-2}) {
    const Matrix rates = testing::with_noise(data.derivatives, noise, 3);
    const auto system =
        testing::monomial_system(data.states, rates, 3).with_target_error(Vector::Zero(3));
    const std::size_t expected[] = {2, 2, 3};
    for (Index k = 0; k < 3; ++k) {
      const PruneResult result = MinorTerms().prune(system, k, system.all_terms(), Ols());
      EXPECT_EQ(result.kept.size(), expected[k]) << noise << ", equation " << k;
      for (const Removal& gone : result.removed) EXPECT_LE(gone.value, gone.threshold);
    }
  }
}

TEST(MinorTerms, TermsThatFitTheSystematicErrorLeave) {
  const auto& data = rossler_10000();
  const Vector error = 1e-4 * data.states.col(0).cwiseProduct(data.states.col(1));
  Matrix rates = testing::with_noise(data.derivatives, 1e-5, 3);
  rates.col(0) += error;
  const auto system = testing::monomial_system(data.states, rates, 3);
  const auto kept = [&](double rms) {
    const auto known = system.with_target_error(Vector::Constant(3, rms));
    return MinorTerms().prune(known, 0, known.all_terms(), Ols()).kept.size();
  };
  EXPECT_EQ(kept(error.norm() / 100.0), 2u);
  EXPECT_EQ(kept(0.0), 3u);
}

TEST(MinorTerms, PaperTolerancesBoundTheResidualPerRow) {
  const auto& data = rossler_10000();
  const auto system =
      testing::monomial_system(data.states, testing::with_noise(data.derivatives, 1e-4, 3), 3);
  MinorTermsOptions options;
  options.tolerances = MinorTermsOptions::Tolerances::Paper;
  testing::expect_rossler_terms(MinorTerms(options), rossler_10000().derivatives, 3);
  const PruneResult found = MinorTerms(options).prune(system, 0, system.all_terms(), Ols());
  EXPECT_EQ(found.kept.size(), 2u);
  for (const Removal& gone : found.removed) EXPECT_DOUBLE_EQ(gone.threshold, 0.1);
  options.eta = 1e-9;  // already the fit of all terms is worse
  const PruneResult nothing = MinorTerms(options).prune(system, 0, system.all_terms(), Ols());
  EXPECT_TRUE(nothing.removed.empty());
}

/// 400 rows of 300 random columns, of which five make the target.
LeastSquaresSystem wide_system(double noise, Folding folding = Folding::Automatic) {
  Random random(4);
  const Matrix theta = Matrix::NullaryExpr(400, 300, [&] { return random.normal(); });
  Matrix y = theta(Eigen::all, {7, 60, 150, 151, 299}) * Vector::Constant(5, 0.5);
  for (double& value : y.reshaped()) value += noise * random.normal();
  std::vector<std::string> names;
  for (int j = 0; j < 300; ++j) names.push_back("t" + std::to_string(j));
  return LeastSquaresSystem(make_row_source(theta, y), names, {"y"}, {}, folding);
}

TEST(MinorTerms, WideProblemsBeginWithTheTermsThatExplainMost) {
  const LeastSquaresSystem system = wide_system(0.05);
  const PruneResult result = MinorTerms().prune(system, 0, system.all_terms(), Ols());
  EXPECT_EQ(result.kept, (TermSet{7, 60, 150, 151, 299}));
  ASSERT_EQ(result.removed.size(), 295U);
  EXPECT_EQ(std::count_if(result.removed.begin(), result.removed.end(),
                          [](const Removal& removal) {
                            return removal.quantity ==
                                   "|residual| of the terms that explain most";
                          }),
            300 - 128);
  for (std::size_t i = 0; i < result.removed.size(); ++i) {
    EXPECT_EQ(result.removed[i].step, static_cast<int>(i) + 1);
    EXPECT_LE(result.removed[i].value, result.removed[i].threshold);
  }
}

TEST(MinorTerms, WideProblemsGiveTheSameFromTheGramAndFromTheTriangle) {
  const LeastSquaresSystem gram = wide_system(0.05),
                           triangle = wide_system(0.05, Folding::Orthogonal);
  ASSERT_GT(gram.factor().gram.size(), 0);
  TermSet some = gram.all_terms();
  std::erase(some, Index{100});
  for (const TermSet& active : {gram.all_terms(), some}) {
    const PruneResult one = MinorTerms().prune(gram, 0, active, Ols()),
                      other = MinorTerms().prune(triangle, 0, active, Ols());
    EXPECT_EQ(one.kept, other.kept);
    ASSERT_EQ(one.removed.size(), other.removed.size());
    for (std::size_t i = 0; i < one.removed.size(); ++i) {
      EXPECT_EQ(one.removed[i].term, other.removed[i].term);
      EXPECT_NEAR(one.removed[i].value, other.removed[i].value, 1e-9 * other.removed[i].value);
      EXPECT_NEAR(one.removed[i].threshold, other.removed[i].threshold,
                  1e-9 * other.removed[i].threshold);
    }
  }
}

TEST(MinorTerms, SurvivesOddProblems) { testing::expect_survives_odd_problems(MinorTerms()); }

}  // namespace
}  // namespace lacuna
