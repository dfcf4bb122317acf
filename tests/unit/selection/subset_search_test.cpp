// SPDX-License-Identifier: MIT
#include "lacuna/selection/subset_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

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

/// Score of the best of all subsets of so few columns.
double best_of_all(const SubsetSearch& search, double price) {
  double best = search.residual({});
  for (unsigned mask = 1; mask < (1U << search.columns()); ++mask) {
    std::vector<Index> subset;
    for (Index j = 0; j < search.columns(); ++j)
      if (mask >> j & 1U) subset.push_back(j);
    best = std::min(best, search.residual(subset) + price * static_cast<double>(subset.size()));
  }
  return best;
}

TEST(SubsetSearch, IsTheBestOfAllSubsets) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Matrix rows(60, 9);
    for (double& entry : rows.reshaped()) entry = random.normal();
    rows.col(1) += 3.0 * rows.col(0);
    rows.col(2) += 3.0 * rows.col(1);
    rows.col(8) += rows.col(2) + 0.7 * rows.col(3) - 0.4 * rows.col(5);
    const SubsetSearch search(triangle_of(rows), 6.0);
    EXPECT_NEAR(search.best({}, true).score, best_of_all(search, 6.0), 1e-6) << trial;
  }
}

TEST(SubsetSearch, ColumnsOnTheVergeOfDependenceComeToAnEnd) {
  Matrix rows = problem(1.0);
  Random random(4);
  for (Index j = 0; j < 6; ++j)
    for (Index i = 0; i < rows.rows(); ++i)
      rows(i, 2 * j + 1) = rows(i, 2 * j) + 1e-8 * random.normal();
  rows.col(12) *= 1e6;
  const SubsetSearch search(triangle_of(rows), 12.0);
  const Subset found = search.best({{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}, true);
  EXPECT_LE(found.score, search.residual({}));
}

TEST(SubsetSearch, NothingIsChosenWhereNothingPays) {
  EXPECT_TRUE(SubsetSearch(triangle_of(problem(1.0)), 1e9).best({}, true).columns.empty());
}

}  // namespace
}  // namespace lacuna
