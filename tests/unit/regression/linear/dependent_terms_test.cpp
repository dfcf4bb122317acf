// SPDX-License-Identifier: MIT
// Terms that the data cannot tell apart: columns that depend on each other, columns of zeros,
// fewer rows than terms.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/linear/subproblem.hpp"

namespace lacuna {
namespace {

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
