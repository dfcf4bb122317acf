// SPDX-License-Identifier: MIT
#include "lacuna/solvers/entropic.hpp"

#include <gtest/gtest.h>

#include "lacuna/solvers/frols.hpp"
#include "lacuna/solvers/stlsq.hpp"
#include "support/sparse_problem.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

using testing::RandomRows;
using testing::sparse_problem;

Regression fitted(const Regressor& regressor, const LeastSquaresSystem& system,
                  const RunContext& context = {}) {
  return regressor.fit(system, system.subproblem(0, system.all_terms()), Effort::Final, context);
}

TEST(Entropic, TakesTheTermsThatExplainTheTarget) {
  for (const double noise : {0.0, 0.01, 0.1, 0.5})
    for (const std::uint64_t seed : {5, 6, 7}) {
      const Regression fit =
          fitted(Entropic(), sparse_problem(500, noise, 0.0, seed));
      EXPECT_EQ(fit.active, (TermSet{1, 4, 7})) << noise << " " << seed;
      for (const Removal& gone : fit.removed) EXPECT_LE(gone.value, gone.threshold);
    }
}

/// The second equation of Lorenz, dy/dt = 28 x - y - x z, among the 20 terms of degree 3, on
/// points of a box; one rate of ten is off by ten times the deviation of all.
RandomRows lorenz_with_outliers(double noise) {
  Random random(3);
  const Index n = 1000;
  RandomRows rows{Matrix(n, 20), Vector(n)};
  for (Index i = 0; i < n; ++i) {
    const double x = random.uniform(-18.0, 18.0), y = random.uniform(-25.0, 25.0),
                 z = random.uniform(2.0, 46.0);
    Index term = 0;
    for (int a = 0; a <= 3; ++a)
      for (int b = 0; a + b <= 3; ++b)
        for (int c = 0; a + b + c <= 3; ++c)
          rows.theta(i, term++) = std::pow(x, a) * std::pow(y, b) * std::pow(z, c);
    rows.y[i] = 28.0 * x - y - x * z + noise * random.normal();
    if (random.uniform() < 0.1) rows.y[i] += 2000.0 * random.normal();
  }
  return rows;
}

TEST(Entropic, OutliersDoNotLeadIt) {
  for (const double noise : {0.0, 2.0}) {
    const LeastSquaresSystem system = lorenz_with_outliers(noise).system();
    const Regression fit = fitted(Entropic(), system);
    // y, x and x z in this order of exponents.
    ASSERT_EQ(fit.active, (TermSet{4, 10, 11})) << noise;
    EXPECT_NEAR(fit.coefficients[0], -1.0, 0.02);
    EXPECT_NEAR(fit.coefficients[1], 28.0, 0.1);
    EXPECT_NEAR(fit.coefficients[2], -1.0, 0.01);
    for (const double threshold : {0.01, 0.03, 0.1, 0.3, 1.0})
      EXPECT_NE(fitted(Stlsq({.threshold = threshold}), system).active, fit.active) << threshold;
    EXPECT_NE(fitted(Frols(), system).active, fit.active);
  }
}

TEST(Entropic, TakesAConstantWhereThereIsOne) {
  Random random(4);
  RandomRows rows{Matrix(400, 4), Vector(400)};
  for (Index i = 0; i < 400; ++i) {
    rows.theta.row(i) << 1.0, random.uniform(5.0, 6.0), random.normal(), random.normal();
    rows.y[i] = 2.0 * rows.theta(i, 1) + 0.1 * random.normal();
  }
  EXPECT_EQ(fitted(Entropic(), rows.system()).active, (TermSet{1}));
  rows.y.array() += 3.0;
  EXPECT_EQ(fitted(Entropic(), rows.system()).active, (TermSet{0, 1}));
}

TEST(Entropic, TakesNothingOfNoise) {
  int taken = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    RandomRows rows = testing::random_rows(200, 10, 0, 1.0, random);
    taken += !fitted(Entropic(), rows.system()).active.empty();
  }
  EXPECT_LE(taken, 5);
}

TEST(Entropic, TheSeedDecidesWhichRowsOfManyAreLookedAt) {
  const LeastSquaresSystem system = sparse_problem(5000, 0.1, 0.05);
  const Entropic few({.samples = 300});
  RunContext other;
  other.seed = 17;
  EXPECT_EQ(fitted(few, system).coefficients, fitted(few, system).coefficients);
  EXPECT_EQ(fitted(few, system).active, (TermSet{1, 4, 7}));
  EXPECT_EQ(fitted(few, system, other).active, (TermSet{1, 4, 7}));
}

TEST(Entropic, TakesOneOfEqualTermsAndNoMoreThanAllowed) {
  const LeastSquaresSystem system = sparse_problem(300, 0.1, 0.0);
  EXPECT_EQ(fitted(Entropic({.max_terms = 1}), system).active, (TermSet{1}));
  Random random(5);
  RandomRows rows = testing::random_rows(200, 3, 0, 0.1, random);
  rows.theta.col(2) = rows.theta.col(1);
  rows.y += rows.theta.col(1);
  EXPECT_EQ(fitted(Entropic(), rows.system()).active.size(), 1u);
}

}  // namespace
}  // namespace lacuna
