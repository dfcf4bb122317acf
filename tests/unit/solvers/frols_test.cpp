// SPDX-License-Identifier: MIT
#include "lacuna/solvers/frols.hpp"

#include <gtest/gtest.h>

#include "support/sparse_problem.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

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
