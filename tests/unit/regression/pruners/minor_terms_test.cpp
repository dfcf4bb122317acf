// SPDX-License-Identifier: MIT
#include "lacuna/regression/pruners/minor_terms.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "support/pruner_checks.hpp"

namespace lacuna {
namespace {

using testing::rossler_10000;

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
