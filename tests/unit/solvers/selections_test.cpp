// SPDX-License-Identifier: MIT
// Regressors that take terms away or in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "solvers/frols.hpp"
#include "solvers/sr3.hpp"
#include "solvers/stlsq.hpp"
#include "support/rossler_system.hpp"
#include "support/sparse_problem.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

using testing::rossler_10000;

TEST(Stlsq, FindsRosslersEquations) {
  const auto system =
      testing::monomial_system(rossler_10000().states, rossler_10000().derivatives, 3);
  for (Index k = 0; k < 3; ++k) {
    const Regression fit = Stlsq().fit(system, system.subproblem(k, system.all_terms()));
    EXPECT_THAT(testing::names_of(system, fit.active),
                ::testing::UnorderedElementsAreArray(
                    testing::rossler_terms()[static_cast<std::size_t>(k)]));
    EXPECT_EQ(fit.removed.size() + fit.active.size(), 20u);
  }
}

TEST(Stlsq, RawThresholdRemovesSmallCoefficients) {
  const auto system = testing::sparse_problem(500, 0.05, 0.0);
  StlsqOptions options;
  options.scale = StlsqOptions::Scale::Coefficient;
  options.threshold = 0.7;
  const Regression fit = Stlsq(options).fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_EQ(fit.active, (TermSet{1, 4}));
  for (const Removal& gone : fit.removed) {
    EXPECT_LT(gone.value, 0.7);
    EXPECT_EQ(gone.quantity, "|h|");
  }
}

TEST(Stlsq, RidgeChoosesTermsButLeavesNoBias) {
  const auto system = testing::sparse_problem(500, 0.0, 0.0);
  StlsqOptions options;
  options.alpha = 1.0;
  options.threshold = 0.1;
  const Regression fit = Stlsq(options).fit(system, system.subproblem(0, system.all_terms()));
  ASSERT_EQ(fit.active, (TermSet{1, 4, 7}));
  EXPECT_TRUE(fit.coefficients.isApprox(Eigen::Vector3d(2.0, -1.0, 0.5), 1e-12));
  options.threshold = 0.15;  // 0.22 without the penalty, about half of it with it
  const Regression fewer = Stlsq(options).fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_EQ(fewer.active, (TermSet{1, 4}));
}

TEST(Sr3, FindsTheTermsAndDoesNotShrinkThem) {
  const LeastSquaresSystem system = testing::sparse_problem(300, 0.1, 0.0);
  const Regression fit =
      Sr3({.threshold = 0.05}).fit(system, system.subproblem(0, system.all_terms()));
  ASSERT_EQ(fit.active, (TermSet{1, 4, 7}));
  EXPECT_TRUE(fit.converged);
  EXPECT_TRUE(fit.coefficients.isApprox(system.subproblem(0, {1, 4, 7}).solve(), 1e-10));
}

TEST(Sr3, StopsWhereNeitherHalfStepMoves) {
  // At the end z minimises with w fixed, so with w = z on the kept terms and 0 elsewhere
  // R'(c - R z) = z / nu on the dropped terms and 0 on the kept ones.
  Random random(9);
  const auto data = testing::random_rows(100, 8, 4, 1.0, random);
  const LeastSquaresSystem system = data.system();
  const Sr3Options options{.threshold = 0.15, .relaxation = 0.5};
  const Regression fit = Sr3(options).fit(system, system.subproblem(0, system.all_terms()));
  ASSERT_FALSE(fit.active.empty());
  ASSERT_FALSE(fit.removed.empty());
  const Vector norms = data.theta.colwise().norm();
  const Matrix unit = data.theta * norms.cwiseInverse().asDiagonal();
  Matrix normal = unit.transpose() * unit;
  for (const Removal& gone : fit.removed)
    normal(gone.term, gone.term) += 1.0 / options.relaxation;
  const Vector z = normal.ldlt().solve(unit.transpose() * data.y) / data.y.norm();
  for (const Index kept : fit.active) EXPECT_GE(std::abs(z[kept]), options.threshold);
  for (const Removal& gone : fit.removed) {
    EXPECT_LT(std::abs(z[gone.term]), options.threshold);
    EXPECT_NEAR(gone.value, std::abs(z[gone.term]), 1e-6);
  }
}

TEST(Sr3, PenaltiesDifferInWhatTheyKeep) {
  // With orthonormal columns and nu = 1 a term of y that goes on as w = z stays for good, and
  // one that is shrunk ends at z = c - t where c > 2 t, else at c / 2, out of the model.
  const Matrix columns = Matrix::Identity(6, 4);
  const Vector y = (Vector(6) << 0.30, 0.19, 0.12, -0.21, 0.0, 0.0).finished();
  const Vector target = y / y.norm();
  const double t = 0.1 / y.norm();
  const LeastSquaresSystem system(make_row_source(columns, target), {"a", "b", "c", "d"},
                                  {"y"});
  const auto kept = [&](Sr3Options::Penalty penalty, double clip) {
    const Sr3 regressor({.threshold = t, .penalty = penalty, .clip = clip});
    return regressor.fit(system, system.subproblem(0, system.all_terms())).active;
  };
  EXPECT_EQ(kept(Sr3Options::Penalty::L0, 5.0), (TermSet{0, 1, 2, 3}));
  EXPECT_EQ(kept(Sr3Options::Penalty::L1, 5.0), (TermSet{0, 3}));
  EXPECT_EQ(kept(Sr3Options::Penalty::Clipped, 1.0), (TermSet{0, 1, 3}));
  EXPECT_EQ(kept(Sr3Options::Penalty::Clipped, 1e6), kept(Sr3Options::Penalty::L1, 5.0));
}

/// The terms in the order of classical Gram-Schmidt on the rows, as long as ERR >= threshold.
std::vector<Index> gram_schmidt_order(const testing::RandomRows& data, double threshold) {
  Matrix w = data.theta;
  std::vector<Index> order;
  for (;;) {
    Index best = -1;
    double largest = threshold;
    for (Index j = 0; j < w.cols(); ++j) {
      if (std::find(order.begin(), order.end(), j) != order.end()) continue;
      const double ratio =
          std::pow(w.col(j).dot(data.y), 2) / w.col(j).squaredNorm() / data.y.squaredNorm();
      if (ratio < largest) continue;
      largest = ratio;
      best = j;
    }
    if (best < 0) return order;
    order.push_back(best);
    const Vector taken = w.col(best);
    for (Index j = 0; j < w.cols(); ++j)
      if (j != best) w.col(j) -= taken * (taken.dot(w.col(j)) / taken.squaredNorm());
  }
}

TEST(Frols, TakesTheTermsOfGramSchmidt) {
  Random random(2);
  for (int draw = 0; draw < 20; ++draw) {
    const auto data = testing::random_rows(80, 12, 5, 0.5, random);
    const LeastSquaresSystem system = data.system();
    FrolsOptions options;
    options.threshold = 0.003;
    std::vector<Index> expected = gram_schmidt_order(data, 0.003);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(Frols(options).fit(system, system.subproblem(0, system.all_terms())).active,
              expected);
  }
}

TEST(Frols, EndsWhereTheScoreIsLeast) {
  const LeastSquaresSystem system = testing::sparse_problem(300, 0.1, 0.0);
  const Regression fit = Frols().fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_EQ(fit.active, (TermSet{1, 4, 7}));
  for (const Removal& gone : fit.removed) EXPECT_LT(gone.value, gone.threshold);
}

TEST(Frols, TakesNoMoreTermsThanAllowed) {
  const LeastSquaresSystem system = testing::sparse_problem(300, 0.1, 0.0);
  const Regression fit =
      Frols({.max_terms = 1}).fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_EQ(fit.active, (TermSet{1}));
}

}  // namespace
}  // namespace lacuna
