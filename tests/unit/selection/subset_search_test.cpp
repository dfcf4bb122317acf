// SPDX-License-Identifier: MIT
#include "lacuna/selection/subset_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include "lacuna/core/random.hpp"

namespace lacuna {
namespace {

using testing::ElementsAre;

Matrix triangle_of(const Matrix& rows) {
  return Eigen::HouseholderQR<Matrix>(rows)
      .matrixQR()
      .topRows(rows.cols())
      .triangularView<Eigen::Upper>();
}

/// 400 rows of 12 columns that have a lot in common; y = 2 a_1 - 3 a_4 + a_9 + noise.
Matrix problem(double noise) {
  Random random(11);
  Matrix rows(400, 13);
  for (Index i = 0; i < 400; ++i) {
    const double common = random.normal();
    for (Index j = 0; j < 12; ++j) rows(i, j) = 3.0 * common + random.normal();
    rows(i, 12) = 2.0 * rows(i, 1) - 3.0 * rows(i, 4) + rows(i, 9) + noise * random.normal();
  }
  return rows;
}

TEST(SubsetSearch, FindsTheColumnsThatMakeTheTarget) {
  const SubsetSearch search(triangle_of(problem(1.0)), 12.0);
  const Subset found = search.best({}, true);
  EXPECT_THAT(found.columns, ElementsAre(1, 4, 9));
  const Vector h = search.solve(found.columns);
  EXPECT_NEAR(h[0], 2.0, 0.3);
  EXPECT_NEAR(h[1], -3.0, 0.3);
  EXPECT_NEAR(found.score, search.residual(found.columns) + 36.0, 1e-9);
}

TEST(SubsetSearch, LossIsTheGainOfTakingItBack) {
  const SubsetSearch search(triangle_of(problem(1.0)), 12.0);
  const Vector losses = search.losses({1, 4, 9});
  EXPECT_NEAR(losses[1], search.gains({1, 9})[4], 1e-6 * losses[1]);
  EXPECT_NEAR(losses[1], search.residual({1, 9}) - search.residual({1, 4, 9}),
              1e-6 * losses[1]);
}

TEST(SubsetSearch, VarianceIsThatOfLeastSquares) {
  const Matrix rows = problem(1.0);
  Matrix chosen(400, 2);
  chosen << rows.col(1), rows.col(4);
  const Matrix expected = (chosen.transpose() * chosen).inverse();
  const Vector variances = SubsetSearch(triangle_of(rows), 1.0).variances({1, 4});
  EXPECT_NEAR(variances[0], expected(0, 0), 1e-9 * expected(0, 0));
}

TEST(SubsetSearch, AWrongStartDoesNotMatter) {
  const SubsetSearch search(triangle_of(problem(1.0)), 12.0);
  EXPECT_THAT(search.best({{0, 2, 3, 5}}, true).columns, ElementsAre(1, 4, 9));
}

TEST(SubsetSearch, DependentAndEmptyColumnsAreNotAdded) {
  Matrix rows = problem(0.1);
  rows.col(2) = rows.col(1) - 2.0 * rows.col(4);
  rows.col(3).setZero();
  const SubsetSearch search(triangle_of(rows), 12.0);
  const Subset found = search.best({}, true);
  EXPECT_LE(found.columns.size(), 3U);
  EXPECT_TRUE(search.solve(found.columns).allFinite());
  EXPECT_EQ(search.gains({1, 4})[3], 0.0);
}

TEST(SubsetSearch, NothingIsChosenWhereNothingPays) {
  EXPECT_TRUE(SubsetSearch(triangle_of(problem(1.0)), 1e9).best({}, true).columns.empty());
}

}  // namespace
}  // namespace lacuna
