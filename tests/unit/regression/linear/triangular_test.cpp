// SPDX-License-Identifier: MIT
#include "regression/linear/triangular.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Matrix random_triangle(Index size) {
  Matrix r = Matrix::Random(size, size).triangularView<Eigen::Upper>();
  r.diagonal().array() += 3.0;
  return r;
}

double least_squares_residual(const Matrix& a, const Vector& y) {
  return (y - a * a.colPivHouseholderQr().solve(y)).norm();
}

TEST(Retriangularise, KeepsInnerProducts) {
  const TermSet heights{1, 2, 5, 7};
  const Matrix columns = random_triangle(9)(Eigen::all, heights);
  const Vector target = Vector::Random(9);
  const TriangularProblem problem = retriangularise(columns, target, heights);
  const Matrix& r = problem.triangle;
  EXPECT_TRUE(r.isUpperTriangular(0.0));
  EXPECT_LT((r.transpose() * r - columns.transpose() * columns).norm(), 1e-13);
  EXPECT_LT((r.transpose() * problem.target - columns.transpose() * target).norm(), 1e-13);
  EXPECT_NEAR(problem.residual, least_squares_residual(columns, target), 1e-14);
}

TEST(RemoveColumn, LeavesTheProblemOfTheOtherColumns) {
  for (Index position = 0; position < 6; ++position) {
    const Matrix r = random_triangle(6);
    const Vector c = Vector::Random(6);
    TriangularProblem problem{r, c, 0.5};
    remove_column(problem, position);
    TermSet others;
    for (Index i = 0; i < 6; ++i) {
      if (i != position) others.push_back(i);
    }
    const Matrix rest = r(Eigen::all, others);
    EXPECT_TRUE(problem.triangle.isUpperTriangular(0.0));
    EXPECT_LT(
        (problem.triangle.transpose() * problem.triangle - rest.transpose() * rest).norm(),
        1e-13);
    EXPECT_LT((problem.triangle.transpose() * problem.target - rest.transpose() * c).norm(),
              1e-13);
    EXPECT_NEAR(problem.residual, std::hypot(0.5, least_squares_residual(rest, c)), 1e-14);
  }
}

TEST(RemoveDependentColumns, KeepsTheEarlierOfTwo) {
  Matrix a = Matrix::Random(20, 5);
  a.col(3) = a.col(1) + 2.0 * a.col(0);
  const Vector y = Vector::Random(20);
  Matrix all(20, 6);
  all << a, y;
  const Matrix r = all.householderQr().matrixQR().topRows(6).triangularView<Eigen::Upper>();
  TriangularProblem problem{r.topLeftCorner(5, 5), r.col(5).head(5), std::abs(r(5, 5))};
  EXPECT_TRUE(is_rank_deficient(problem.triangle, rank_tolerance(5, 20)));
  EXPECT_EQ(remove_dependent_columns(problem, rank_tolerance(5, 20)), TermSet{3});
  EXPECT_FALSE(is_rank_deficient(problem.triangle, rank_tolerance(4, 20)));
  EXPECT_NEAR(problem.residual, least_squares_residual(a, y), 1e-13);
}

TEST(RankTolerance, LiesBetweenRoundingAndWhatRowsCanTell) {
  for (const Index rows : {30, 3000}) {
    for (int draw = 0; draw < 20; ++draw) {
      Matrix a = Matrix::Random(rows, 8);
      a.col(7) = a.leftCols(7) * Vector::Random(7);
      a.colwise().normalize();
      const auto last = [&] { return std::abs(a.householderQr().matrixQR()(7, 7)); };
      EXPECT_LT(last(), rank_tolerance(8, rows));
      a.col(7) += 1e-11 * Vector::Random(rows).normalized();
      EXPECT_GT(last(), rank_tolerance(8, rows));
    }
  }
}

TEST(RemoveDependentColumns, TakesAllColumnsOfAZeroProblem) {
  TriangularProblem problem{Matrix::Zero(3, 3), Vector::Zero(3), 1.0};
  EXPECT_EQ(remove_dependent_columns(problem, 1e-12), (TermSet{0, 1, 2}));
  EXPECT_EQ(problem.residual, 1.0);
}

TEST(ConditionEstimate, IsWithinAFactorOfTheTruth) {
  for (int trial = 0; trial < 50; ++trial) {
    Matrix r = Matrix::Random(12, 12).triangularView<Eigen::Upper>();
    r.diagonal().array() += 0.3;
    const double norm = r.cwiseAbs().colwise().sum().maxCoeff();
    const double inverse = r.inverse().cwiseAbs().colwise().sum().maxCoeff();
    EXPECT_LE(condition_estimate(r), norm * inverse * (1.0 + 1e-9));
    EXPECT_GE(condition_estimate(r), norm * inverse / 5.0);
  }
}

TEST(InverseNormEstimate, IsFromBelowAndNear) {
  for (int trial = 0; trial < 50; ++trial) {
    Matrix r = Matrix::Random(12, 12).triangularView<Eigen::Upper>();
    r.diagonal().array() += 0.3;
    const double inverse = r.inverse().cwiseAbs().colwise().sum().maxCoeff();
    EXPECT_LE(inverse_norm_estimate(r), inverse * (1.0 + 1e-9));
    EXPECT_GE(inverse_norm_estimate(r), inverse / 5.0);
  }
  EXPECT_EQ(inverse_norm_estimate(Matrix(0, 0)), 0.0);
  EXPECT_TRUE(std::isinf(inverse_norm_estimate(Matrix::Zero(2, 2))));
}

TEST(ConditionEstimate, HandlesTheExtremes) {
  EXPECT_EQ(condition_estimate(Matrix(0, 0)), 1.0);
  EXPECT_DOUBLE_EQ(condition_estimate(Matrix::Identity(4, 4)), 1.0);
  EXPECT_TRUE(std::isinf(condition_estimate(Matrix::Zero(2, 2))));
}

TEST(Triangular, ShapesAndNumbersHaveToFit) {
  const Matrix columns = Matrix::Identity(3, 2);
  EXPECT_THROW(retriangularise(columns, Vector::Ones(2), {0, 1}), ArgumentError);
  EXPECT_THROW(retriangularise(columns, Vector::Ones(3), {0}), ArgumentError);
  EXPECT_THROW(retriangularise(columns, Vector::Ones(3), {1, 0}), ArgumentError);
  EXPECT_THROW(retriangularise(columns, Vector::Ones(3), {0, 3}), ArgumentError);
  TriangularProblem problem{Matrix::Identity(2, 2), Vector::Ones(2), 0.0};
  EXPECT_THROW(remove_column(problem, -1), ArgumentError);
  EXPECT_THROW(remove_column(problem, 2), ArgumentError);
  problem.target = Vector::Ones(3);
  EXPECT_THROW(remove_column(problem, 0), ArgumentError);
  EXPECT_THROW(rank_tolerance(2, -1), ArgumentError);
  EXPECT_THROW(condition_estimate(columns), ArgumentError);
}

}  // namespace
}  // namespace lacuna
