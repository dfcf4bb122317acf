// SPDX-License-Identifier: MIT
#include "lacuna/regression/filters/svd_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "support/stage_invariance.hpp"

namespace lacuna {
namespace {

/// Random columns a, b, c and a+b, c once more, zero.
LeastSquaresSystem rank_three() {
  Random random(2);
  Matrix theta = Matrix::Zero(40, 6);
  for (Index i = 0; i < 40; ++i)
    for (Index j = 0; j < 3; ++j) theta(i, j) = random.normal();
  theta.col(3) = theta.col(0) + theta.col(1);
  theta.col(4) = 3.0 * theta.col(2);
  return {
      make_row_source(theta, Matrix::Ones(40, 1)), {"a", "b", "c", "a+b", "3c", "0"}, {"y"}};
}

TEST(SvdFilter, KeepsAsManyTermsAsTheRankAndPrefersTheFirst) {
  const FilterResult result = SvdFilter().filter(rank_three());
  EXPECT_EQ(result.kept, (TermSet{0, 1, 2}));
  ASSERT_EQ(result.removed.size(), 3u);
  for (const Removal& gone : result.removed) EXPECT_LT(gone.value, 1e-8);
}

TEST(SvdFilter, KeepsAllTermsOfRosslersAttractorHoweverWritten) {
  const auto& data = testing::rossler_10000();
  ASSERT_FALSE(testing::rewritings().empty());
  for (const auto& r : testing::rewritings()) {
    const auto system = testing::rewritten(data.states, data.derivatives, 5, r);
    EXPECT_EQ(SvdFilter().filter(system).kept.size(), 56u) << r.name;
  }
}

TEST(SvdFilter, KeptColumnsAreWellConditioned) {
  const auto& data = testing::rossler_10000();
  const auto system = testing::monomial_system(data.states, data.derivatives, 4);
  const FilterResult result = SvdFilter({.tolerance = 1e-2}).filter(system);
  EXPECT_LT(result.kept.size(), 35u);
  const Matrix kept = system.factor().triangle.topRows(35)(Eigen::all, result.kept);
  const Vector singular = Eigen::JacobiSVD<Matrix>(kept).singularValues();
  EXPECT_GE(singular.minCoeff() / singular.maxCoeff(), 1e-3);
}

TEST(SvdFilter, RemovesEverythingThatIsZero) {
  const LeastSquaresSystem system(make_row_source(Matrix::Zero(5, 2), Matrix::Ones(5, 1)),
                                  {"a", "b"}, {"y"});
  EXPECT_TRUE(SvdFilter().filter(system).kept.empty());
}

}  // namespace
}  // namespace lacuna
