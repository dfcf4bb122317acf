// SPDX-License-Identifier: MIT
// Terms in the order of orthogonal least squares, and those that depend on each other.
#include "regression/linear/forward_order.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "lacuna/regression/linear/least_squares_system.hpp"

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

// Terms that the data cannot tell apart: columns that depend on each other, columns of zeros,
// fewer rows than terms.
LeastSquaresSystem system_of(const Matrix& theta, const Vector& target, Folding folding) {
  return LeastSquaresSystem(make_row_source(theta, target),
                            std::vector<std::string>(std::size_t(theta.cols()), "t"), {"y"}, {},
                            folding);
}

double best_residual(const Matrix& theta, const Vector& y) {
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition;
  decomposition.setThreshold(1e-10);
  decomposition.compute(theta);
  return (y - theta * decomposition.solve(y)).norm();
}

// x^2 + y^2 = 1 on the data, and x twice.
Matrix circle_terms(Index n) {
  const Vector angle = Vector::LinSpaced(n, 0.0, 40.0);
  Matrix theta(n, 6);
  theta.col(0).setOnes();
  theta.col(1) = angle.array().cos();
  theta.col(2) = angle.array().sin();
  theta.col(3) = theta.col(1);
  theta.col(4) = theta.col(1).cwiseAbs2();
  theta.col(5) = theta.col(2).cwiseAbs2();
  return theta;
}

class DependentTerms : public ::testing::TestWithParam<Folding> {};

TEST_P(DependentTerms, TheLastOfThemGetsZero) {
  for (const Index n : {50, 3000, 100'000}) {
    const Matrix theta = circle_terms(n);
    const Vector target = Vector::Random(n);
    const auto problem = system_of(theta, target, GetParam()).subproblem(0, {0, 1, 2, 3, 4, 5});
    const Vector h = problem.solve();
    EXPECT_EQ(h[3], 0.0);
    EXPECT_EQ(h[5], 0.0);
    EXPECT_NEAR((target - theta * h).norm(), best_residual(theta, target), 1e-9);
    EXPECT_NEAR(problem.residual_norm(), best_residual(theta, target), 1e-9);
  }
}

TEST_P(DependentTerms, RefinementLeavesTheZeros) {
  const Matrix theta = circle_terms(1000);
  const Vector target = Vector::Random(1000);
  const auto system = system_of(theta, target, GetParam());
  const auto problem = system.subproblem(0, {0, 1, 2, 3, 4, 5});
  const Vector h = system.refined(problem, problem.solve());
  EXPECT_EQ(h[3], 0.0);
  EXPECT_EQ(h[5], 0.0);
  EXPECT_LT((h - problem.solve()).norm(), 1e-9 * h.norm());
}

TEST_P(DependentTerms, OnlyTheirVariancesAreInfinite) {
  const Matrix theta = circle_terms(1000);
  const auto system = system_of(theta, Vector::Random(1000), GetParam());
  const Vector variance = system.subproblem(0, {0, 1, 2, 3, 4, 5}).inverse_gram_diagonal();
  for (const Index i : {0, 1, 3, 4, 5}) EXPECT_TRUE(std::isinf(variance[i])) << i;
  const Matrix full = theta(Eigen::all, std::vector<Index>{0, 1, 2, 4});
  const double expected = (full.transpose() * full).inverse()(2, 2);
  EXPECT_NEAR(variance[2] / expected, 1.0, 1e-9);
}

TEST_P(DependentTerms, EliminationMakesTheOthersDetermined) {
  const Matrix theta = circle_terms(1000);
  const Vector target = Vector::Random(1000);
  auto problem = system_of(theta, target, GetParam()).subproblem(0, {0, 1, 2, 3, 4, 5});
  problem.remove(1);
  problem.remove(0);
  const Matrix rest = theta.rightCols(4);
  const Vector expected = rest.colPivHouseholderQr().solve(target);
  EXPECT_LT((problem.solve() - expected).norm(), 1e-11 * expected.norm());
}

TEST_P(DependentTerms, ColumnsOfZerosGetZero) {
  Matrix theta = Matrix::Random(200, 4);
  theta.col(0).setZero();
  theta.col(2).setZero();
  const Vector target = Vector::Random(200);
  const auto system = system_of(theta, target, GetParam());
  Subproblem problem = system.subproblem(0, {0, 1, 2, 3});
  const Vector h = system.refined(problem, problem.solve());
  EXPECT_EQ(h[0], 0.0);
  EXPECT_EQ(h[2], 0.0);
  EXPECT_NEAR((target - theta * h).norm(), best_residual(theta, target), 1e-12);
  EXPECT_TRUE(std::isinf(problem.inverse_gram_diagonal()[0]));
  EXPECT_TRUE(std::isfinite(problem.inverse_gram_diagonal()[1]));
  problem.remove(1);
  EXPECT_EQ(problem.solve()[0], 0.0);
  EXPECT_NEAR(problem.residual_norm(), best_residual(theta.col(3), target), 1e-12);
}

TEST_P(DependentTerms, FewerRowsThanTermsFitExactly) {
  const Matrix theta = Matrix::Random(4, 7);
  const Vector target = Vector::Random(4);
  const auto problem =
      system_of(theta, target, GetParam()).subproblem(0, {0, 1, 2, 3, 4, 5, 6});
  const Vector h = problem.solve();
  EXPECT_LT((target - theta * h).norm(), 1e-6 * target.norm());
  EXPECT_LT(problem.residual_norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Foldings, DependentTerms,
                         ::testing::Values(Folding::Automatic, Folding::Gram,
                                           Folding::Orthogonal, Folding::Deflated));

}  // namespace
}  // namespace lacuna
