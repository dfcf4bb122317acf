// SPDX-License-Identifier: MIT
#include "regression/linear/forward_order.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

namespace lacuna {
namespace {

Matrix random_numbers(Index rows, Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// |y - A_S h|^2 of least squares.
double left_by(const Matrix& a, const Vector& y, const std::vector<Index>& subset) {
  if (subset.empty()) return y.squaredNorm();
  const Matrix part = a(Eigen::all, subset);
  return (y - part * part.colPivHouseholderQr().solve(y)).squaredNorm();
}

TEST(ForwardOrder, EachColumnIsTheBestBesideThoseBefore) {
  const Matrix a = random_numbers(40, 12, 1);
  const Vector y = random_numbers(40, 1, 2);
  const ForwardOrder order = forward_order(a, y, {.fewest = 6});
  ASSERT_EQ(order.columns.size(), 12U);  // enough = 0: until nothing is left
  std::vector<Index> subset;
  for (const Index taken : order.columns) {
    std::vector<double> left;
    for (Index j = 0; j < a.cols(); ++j) {
      std::vector<Index> with = subset;
      if (std::find(with.begin(), with.end(), j) == with.end()) with.push_back(j);
      left.push_back(left_by(a, y, with));
    }
    EXPECT_EQ(std::min_element(left.begin(), left.end()) - left.begin(), taken);
    subset.push_back(taken);
  }
  EXPECT_NEAR(order.left, left_by(a, y, subset), 1e-12 * y.squaredNorm());
}

TEST(ForwardOrder, EndsWhereEnoughIsExplained) {
  const Matrix a = random_numbers(50, 20, 3);
  const Vector y = a.col(4) - 2.0 * a.col(11) + 1e-3 * random_numbers(50, 1, 4);
  ForwardOrder order = forward_order(a, y, {.enough = 1e-2 * y.squaredNorm()});
  std::sort(order.columns.begin(), order.columns.end());
  EXPECT_EQ(order.columns, (std::vector<Index>{4, 11}));
  EXPECT_EQ(forward_order(a, y, {.fewest = 7, .enough = 1e-2 * y.squaredNorm()}).columns.size(),
            7U);
}

TEST(ForwardOrder, SomeComeFirstAndDependentOnesNever) {
  Matrix a = random_numbers(30, 6, 5);
  a.col(3) = a.col(1) + a.col(2);
  const Vector y = a.col(0) + random_numbers(30, 1, 6);
  const ForwardOrder order = forward_order(a, y, {.first = {1, 2, 3}, .fewest = 6});
  ASSERT_EQ(order.columns.size(), 5U);
  EXPECT_EQ(order.columns[0], 1);
  EXPECT_EQ(order.columns[1], 2);
  EXPECT_EQ(std::count(order.columns.begin(), order.columns.end(), 3), 0);
}

TEST(ForwardOrder, TheGramGivesTheSameOrder) {
  Matrix all = random_numbers(60, 17, 8);
  all.col(6) = all.col(0) - all.col(5);
  const Matrix gram = all.transpose() * all;
  const Matrix a = all.leftCols(15);
  for (const Index target : {Index{15}, Index{16}}) {
    const ForwardLimits limits{.first = {3}, .fewest = 9, .enough = 1e9};
    const ForwardOrder direct = forward_order(a, all.col(target), limits);
    const ForwardOrder products = forward_order_in_gram(gram, 15, target, limits);
    EXPECT_EQ(direct.columns, products.columns);
    EXPECT_NEAR(direct.left, products.left, 1e-10);
  }
}

}  // namespace
}  // namespace lacuna
