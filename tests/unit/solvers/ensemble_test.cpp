// SPDX-License-Identifier: MIT
#include "lacuna/solvers/ensemble.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/sparse_problem.hpp"

namespace lacuna {
namespace {

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
