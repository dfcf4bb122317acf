// SPDX-License-Identifier: MIT
// The best subset, and what many draws of rows agree on.
#include "solvers/best_subset.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "solvers/ensemble.hpp"
#include "solvers/subset_fit.hpp"
#include "support/sparse_problem.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

using testing::random_rows;
using testing::RandomRows;

double score_of(const RandomRows& data, const std::vector<Index>& terms, double penalty) {
  const auto n = static_cast<double>(data.y.size());
  return 2.0 * n * std::log(std::max(data.residual(terms) / data.y.norm(), 1e-12)) +
         penalty * std::log(n) * static_cast<double>(terms.size());
}

/// The least score of all sets of at most `most` terms, each fitted to the rows.
double least_of_all(const RandomRows& data, Index most, double penalty) {
  double least = std::numeric_limits<double>::infinity();
  const auto sets = 1u << static_cast<unsigned>(data.theta.cols());
  for (unsigned set = 0; set < sets; ++set) {
    std::vector<Index> terms;
    for (Index j = 0; j < data.theta.cols(); ++j)
      if ((set >> static_cast<unsigned>(j) & 1u) != 0) terms.push_back(j);
    if (static_cast<Index>(terms.size()) <= most)
      least = std::min(least, score_of(data, terms, penalty));
  }
  return least;
}

TEST(SubsetScore, IsThatOfSchwarz) {
  Random random(3);
  const RandomRows data = random_rows(50, 3, 2, 0.5, random);
  const LeastSquaresSystem system = data.system();
  const SubsetScore score(system.subproblem(0, system.all_terms()), 1.5);
  const double y = data.y.norm();
  EXPECT_NEAR(score(0.1 * y, 3), 100.0 * std::log(0.1) + 4.5 * std::log(50.0), 1e-9);
  EXPECT_EQ(score(1e-14 * y, 3), score(1e-13 * y, 3));
  const double r = 0.4 * y, gain = score.least_gain(r);
  EXPECT_NEAR(score(std::sqrt(r * r - gain), 4), score(r, 3), 1e-9);
}

TEST(BestSubset, IsTheBestOfAllSets) {
  Random random(17);
  for (int draw = 0; draw < 200; ++draw) {
    const Index terms = draw % 20 == 0 ? 14 : 3 + static_cast<Index>(random.below(8));
    const auto truth = static_cast<Index>(random.below(6));
    const double noise = draw % 7 == 0 ? 0.0 : std::pow(10.0, random.uniform(-4.0, 1.0));
    RandomRows data = random_rows(30, terms, truth + (noise > 0.0 ? 0 : 1), noise, random);
    if (draw % 5 == 0) data.theta.col(2) = data.theta.col(0) - 3.0 * data.theta.col(1);
    BestSubsetOptions options;
    options.penalty = draw % 3 == 0 ? 0.0 : random.uniform(0.2, 2.0);
    options.max_terms = 1 + static_cast<int>(random.below(6));
    const LeastSquaresSystem system = data.system();
    const Regression found =
        BestSubset(options).fit(system, system.subproblem(0, system.all_terms()));
    EXPECT_TRUE(found.converged);
    EXPECT_LE(static_cast<int>(found.active.size()), options.max_terms);
    EXPECT_NEAR(score_of(data, found.active, options.penalty),
                least_of_all(data, options.max_terms, options.penalty), 1e-6)
        << "draw " << draw << ", " << terms << " terms";
  }
}

TEST(BestSubset, Proves8Of56TermsInSeconds) {
  Random random(4);
  const RandomRows data = random_rows(2000, 56, 6, 1.0, random);
  const LeastSquaresSystem system = data.system();
  for (const double penalty : {1.0, 0.0}) {
    BestSubsetOptions options;
    options.penalty = penalty;
    const auto begin = std::chrono::steady_clock::now();
    const Regression found =
        BestSubset(options).fit(system, system.subproblem(0, system.all_terms()));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    EXPECT_TRUE(found.converged) << penalty;
    EXPECT_LT(taken.count(), 10.0) << penalty << ": " << found.iterations << " branches";
    if (penalty == 0.0) {
      EXPECT_EQ(found.active.size(), 8u);
    }
  }
}

TEST(BestSubset, SaysWhenItIsNotProved) {
  Random random(5);
  const RandomRows data = random_rows(200, 30, 12, 3.0, random);
  const LeastSquaresSystem system = data.system();
  BestSubsetOptions options;
  options.penalty = 0.0;
  options.most_operations = 1e4;
  EXPECT_FALSE(
      BestSubset(options).fit(system, system.subproblem(0, system.all_terms())).converged);
}

TEST(BestSubset, TermsLeftOutHaveTheScoreTheyWouldBring) {
  const LeastSquaresSystem system = testing::sparse_problem(300, 0.1, 0.0);
  const Regression found = BestSubset().fit(system, system.subproblem(0, system.all_terms()));
  ASSERT_EQ(found.active, (TermSet{1, 4, 7}));
  const double n = 300.0, y = system.factor().target_norms[0];
  for (const Removal& gone : found.removed) {
    TermSet with = found.active;
    with.insert(std::upper_bound(with.begin(), with.end(), gone.term), gone.term);
    const double residual = system.subproblem(0, with).residual_norm();
    EXPECT_NEAR(gone.value, 2.0 * n * std::log(residual / y) + 4.0 * std::log(n), 1e-6);
    EXPECT_GT(gone.value, gone.threshold);
  }
}

Regression fit_with(const LeastSquaresSystem& system, EnsembleOptions options,
                    std::uint64_t seed = 1) {
  RunContext context;
  context.seed = seed;
  return Ensemble(options).fit(system, system.subproblem(0, system.all_terms()), Effort::Final,
                               context);
}

std::map<Index, double> probabilities(const Regression& fit) {
  std::map<Index, double> values;
  for (const Removal& gone : fit.removed) values[gone.term] = gone.value;
  return values;
}

TEST(Ensemble, FindsTheTermsWithTheCoefficientsOfAllRows) {
  const LeastSquaresSystem system = testing::sparse_problem(400, 0.3, 0.0);
  for (const int left_out : {0, 3}) {
    EnsembleOptions options;
    options.threshold = 0.05;
    options.left_out = left_out;
    options.inclusion = 0.95;  // of the resamples that offered the term
    const Regression fit = fit_with(system, options);
    ASSERT_EQ(fit.active, (TermSet{1, 4, 7})) << left_out;
    EXPECT_TRUE(fit.coefficients.isApprox(system.subproblem(0, {1, 4, 7}).solve(), 1e-10));
  }
}

TEST(Ensemble, ProbabilitiesAreFractionsOfTheResamples) {
  const LeastSquaresSystem system = testing::sparse_problem(100, 3.0, 0.0);
  EnsembleOptions options;
  options.bags = 8;
  options.threshold = 0.1;
  options.inclusion = 1.0;
  const auto values = probabilities(fit_with(system, options));
  ASSERT_GE(values.size(), 3u);
  bool between = false;
  for (const auto& [term, p] : values) {
    EXPECT_EQ(8.0 * p, std::round(8.0 * p)) << term;
    EXPECT_LT(p, 1.0);
    between = between || p > 0.0;
  }
  EXPECT_TRUE(between);
}

TEST(Ensemble, TheSeedDecides) {
  const LeastSquaresSystem system = testing::sparse_problem(100, 3.0, 0.0);
  EnsembleOptions options;
  options.threshold = 0.1;
  options.inclusion = 1.0;
  EXPECT_EQ(probabilities(fit_with(system, options, 5)),
            probabilities(fit_with(system, options, 5)));
  EXPECT_NE(probabilities(fit_with(system, options, 5)),
            probabilities(fit_with(system, options, 6)));
}

TEST(Ensemble, OneBagOfOneKindOfRowsIsThresholdedLeastSquares) {
  // Blocks that are all alike: every resample is the record itself.
  Random random(3);
  Matrix theta(50, 4);
  for (double& entry : theta.reshaped()) entry = random.normal();
  const Vector y = 2.0 * theta.col(0) + 0.04 * theta.col(2);
  const LeastSquaresSystem system(make_row_source(theta.replicate(4, 1), y.replicate(4, 1)),
                                  {"a", "b", "c", "d"}, {"y"});
  EnsembleOptions options;
  options.blocks = 4;
  options.bags = 3;
  options.threshold = 0.01;
  EXPECT_EQ(fit_with(system, options).active, (TermSet{0, 2}));
  options.threshold = 0.04;
  EXPECT_EQ(fit_with(system, options).active, (TermSet{0}));
}

}  // namespace
}  // namespace lacuna
