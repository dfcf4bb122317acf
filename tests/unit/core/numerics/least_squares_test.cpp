// SPDX-License-Identifier: MIT
#include "core/numerics/least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "core/numerics/constrained_least_squares.hpp"
#include "core/numerics/qr.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/random_matrix.hpp"

namespace lacuna {
namespace {

using testing::random_matrix;

TEST(LeastSquares, IsTheRegressionLine) {
  // y = 1, 3, 4 at x = 0, 1, 2: slope 3/2, intercept 7/6 (mean 8/3 at x = 1).
  Matrix a(3, 2);
  a << 1, 0, 1, 1, 1, 2;
  const Matrix h = least_squares(a, Vector{{1.0, 3.0, 4.0}});
  EXPECT_NEAR(h(0, 0), 7.0 / 6.0, 1e-14);
  EXPECT_NEAR(h(1, 0), 1.5, 1e-14);
  EXPECT_TRUE(smallest_least_squares(a, Vector{{1.0, 3.0, 4.0}}).isApprox(h, 1e-13));
}

TEST(LeastSquares, ADependentColumnGetsNothing) {
  Matrix a(2, 2);
  a << 2, 1, 4, 2;
  const Matrix h = least_squares(a, Vector{{2.0, 4.0}});
  EXPECT_NEAR(h(0, 0), 1.0, 1e-14);
  EXPECT_EQ(h(1, 0), 0.0);
}

TEST(SolveSymmetric, UndoesTheProduct) {
  // Cofactors of [4 2; 2 3] over its determinant 8.
  Matrix a(2, 2), inverse(2, 2);
  a << 4, 2, 2, 3;
  inverse << 3.0 / 8.0, -0.25, -0.25, 0.5;
  EXPECT_TRUE(solve_symmetric(a, Matrix::Identity(2, 2)).isApprox(inverse, 1e-14));
}

TEST(LeastSquares, TheSmallestSharesAmongEqualColumns) {
  const Matrix h = smallest_least_squares(Matrix::Ones(3, 2), Matrix::Constant(3, 1, 4.0));
  EXPECT_NEAR(h(0, 0), 2.0, 1e-14);
  EXPECT_NEAR(h(1, 0), 2.0, 1e-14);
}

TEST(LeastSquares, WithoutRowsAllIsZero) {
  const Matrix none = least_squares(Matrix(0, 2), Matrix(0, 3));
  EXPECT_EQ(none, Matrix::Zero(2, 3));
  EXPECT_EQ(smallest_least_squares(Matrix(0, 2), Matrix(0, 3)), none);
  EXPECT_EQ(least_squares(Matrix(3, 0), Matrix(3, 1)).rows(), 0);
}

TEST(LeastSquares, WhatIsNotFiniteHasNoSolution) {
  Matrix a = Matrix::Identity(2, 2);
  a(1, 0) = std::numeric_limits<double>::quiet_NaN();
  const Matrix b = Matrix::Ones(2, 1);
  for (const Matrix& h : {least_squares(a, b), smallest_least_squares(a, b),
                          solve_symmetric(a, b), Matrix(PivotedQr(a).solve(b))})
    EXPECT_TRUE(h.array().isNaN().all()) << h;
}

TEST(ConstrainedLeastSquares, SolvesTheEquationsOfLagrange) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Matrix r = random_matrix(12, 6, seed);
    r.col(2) *= 1e6;  // columns of any size
    r.col(4) *= 1e-5;
    const Vector c = random_matrix(12, 1, seed + 100);
    const Matrix a = random_matrix(2, 6, seed + 200);
    const Vector b = random_matrix(2, 1, seed + 300);
    const ConstrainedSolution found = constrained_least_squares(r, c, a, b);
    // [R'R A'; A 0] [h; l] = [R'c; b], in columns of unit length
    const Vector scale = r.colwise().norm().cwiseInverse();
    Matrix system = Matrix::Zero(8, 8);
    system.topLeftCorner(6, 6) =
        scale.asDiagonal() * (r.transpose() * r).eval() * scale.asDiagonal();
    system.topRightCorner(6, 2) = scale.asDiagonal() * a.transpose();
    system.bottomLeftCorner(2, 6) = a * scale.asDiagonal();
    Vector right(8);
    right << scale.asDiagonal() * (r.transpose() * c).eval(), b;
    const Matrix inverse = system.fullPivLu().inverse();
    const Vector h = (inverse * right).head(6).cwiseProduct(scale);
    for (Index i = 0; i < 6; ++i) {
      EXPECT_NEAR(found.h[i], h[i], 1e-7 * (std::abs(h[i]) + scale[i]));
      EXPECT_NEAR(found.variances[i], inverse(i, i) * scale[i] * scale[i],
                  1e-7 * scale[i] * scale[i]);
    }
    EXPECT_LT((a * found.h - b).norm(), 1e-9 * (1.0 + found.h.norm() * a.norm()));
  }
}

TEST(ConstrainedLeastSquares, AFixedCoefficientHasNoVariance) {
  const Matrix r = random_matrix(9, 3, 1);
  Matrix a = Matrix::Zero(1, 3);
  a(0, 1) = 1.0;
  const ConstrainedSolution found =
      constrained_least_squares(r, random_matrix(9, 1, 2), a, Vector::Constant(1, 2.5));
  EXPECT_NEAR(found.h[1], 2.5, 1e-14);
  EXPECT_NEAR(found.variances[1], 0.0, 1e-28);
  EXPECT_GT(found.variances[0], 0.0);
}

TEST(ConstrainedLeastSquares, RepeatedConstraintsAreOne) {
  const Matrix r = random_matrix(9, 3, 3);
  const Vector c = random_matrix(9, 1, 4);
  Matrix once = Matrix::Zero(1, 3), twice = Matrix::Zero(2, 3);
  once.row(0) << 1.0, 1.0, 0.0;
  twice.rowwise() = once.row(0);
  EXPECT_LT((constrained_least_squares(r, c, once, Vector::Zero(1)).h -
             constrained_least_squares(r, c, twice, Vector::Zero(2)).h)
                .norm(),
            1e-12);
}

TEST(ConstrainedLeastSquares, WhatTheRowsDoNotTellHasNoFiniteVariance) {
  Matrix r = random_matrix(9, 4, 5);
  r.col(3) = r.col(2);
  Matrix a = Matrix::Zero(1, 4);
  a(0, 0) = 1.0;
  const ConstrainedSolution found =
      constrained_least_squares(r, random_matrix(9, 1, 6), a, Vector::Constant(1, 1.0));
  EXPECT_TRUE(found.h.allFinite());
  EXPECT_TRUE(std::isfinite(found.variances[0]) && std::isfinite(found.variances[1]));
  EXPECT_TRUE(std::isinf(found.variances[2]) && std::isinf(found.variances[3]));
}

TEST(ConstrainedLeastSquares, ContradictionsAreSeen) {
  Matrix a(2, 2);
  a << 1.0, 1.0, 2.0, 2.0;
  EXPECT_TRUE(is_feasible(a, Vector{{1.0, 2.0}}));
  EXPECT_FALSE(is_feasible(a, Vector{{1.0, 3.0}}));
  EXPECT_TRUE(is_feasible(Matrix(0, 2), Vector(0)));
  EXPECT_THROW(constrained_least_squares(a, Vector::Zero(3), a, Vector::Zero(2)),
               ArgumentError);
}

TEST(ConstrainedLeastSquares, FeasibleShapesHaveToFit) {
  EXPECT_THROW(is_feasible(Matrix::Ones(2, 3), Vector::Ones(3)), ArgumentError);
  EXPECT_FALSE(is_feasible(Matrix::Constant(1, 1, NAN), Vector::Ones(1)));
}

Matrix random_rows(Index rows, Index columns, Random& random) {
  Matrix matrix(rows, columns);
  for (double& value : matrix.reshaped()) value = random.normal();
  return matrix;
}

/// A problem with a point that satisfies all of its constraints.
struct Problem {
  explicit Problem(std::uint64_t seed) {
    Random random(seed);
    const Index q = 2 + static_cast<Index>(5.0 * random.uniform());
    const Index equalities = random.uniform() < 0.5 ? 0 : 1;
    const auto inequalities = 1 + static_cast<Index>(6.0 * random.uniform());
    r = random_rows(q + 4, q, random);
    r.col(0) *= std::pow(10.0, 3.0 * random.normal());
    c = 3.0 * random_rows(q + 4, 1, random);
    a = random_rows(equalities, q, random);
    g_rows = random_rows(inequalities, q, random);
    const Vector inside = random_rows(q, 1, random);
    b = a * inside;
    g = g_rows * inside + 0.3 * random_rows(inequalities, 1, random).cwiseAbs();
  }

  double objective(const Vector& h) const { return 0.5 * (r * h - c).squaredNorm(); }

  Matrix r, a, g_rows;
  Vector c, b, g;
};

/// The least objective of all subsets of inequalities taken as equalities that is feasible.
double least_of_subsets(const Problem& p) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned set = 0; set < (1u << p.g.size()); ++set) {
    std::vector<Index> rows;
    for (Index j = 0; j < p.g.size(); ++j)
      if (set & (1u << j)) rows.push_back(j);
    Matrix all(p.a.rows() + static_cast<Index>(rows.size()), p.a.cols());
    all << p.a, p.g_rows(rows, Eigen::all);
    Vector right(all.rows());
    right << p.b, p.g(rows);
    if (!is_feasible(all, right)) continue;
    const Vector h = constrained_least_squares(p.r, p.c, all, right).h;
    if (((p.g_rows * h - p.g).array() < 1e-9).all()) least = std::min(least, p.objective(h));
  }
  return least;
}

/// Residuals of the conditions of Karush, Kuhn and Tucker, in units of what they are made of.
void expect_optimal(const Problem& p, const InequalitySolution& found) {
  const Vector& h = found.solution.h;
  const Vector scale = p.r.colwise().norm().cwiseInverse();  // columns of unit length
  const Vector slope = scale.asDiagonal() * (p.r.transpose() * (p.r * h - p.c));
  const Vector rest = slope + scale.asDiagonal() * p.g_rows.transpose() * found.multipliers;
  const Matrix a = scale.asDiagonal() * p.a.transpose();
  const Vector left = a.cols() ? Vector(rest - a * a.householderQr().solve(rest)) : rest;
  const double size = p.c.norm() + found.multipliers.norm();
  EXPECT_LT(left.norm(), 1e-8 * size);
  EXPECT_LT((p.a * h - p.b).norm(), 1e-8 * (1.0 + p.b.norm()));
  for (Index j = 0; j < p.g.size(); ++j) {
    const double slack = p.g[j] - p.g_rows.row(j).dot(h);
    EXPECT_GE(slack, -1e-8 * (1.0 + std::abs(p.g[j])));
    EXPECT_GE(found.multipliers[j], 0.0);
    EXPECT_LT(std::abs(slack) * found.multipliers[j], 1e-8 * size * (1.0 + std::abs(p.g[j])));
  }
}

TEST(InequalityLeastSquares, SatisfiesTheConditionsOfKarushKuhnAndTucker) {
  std::size_t active = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem(seed);
    const auto found = inequality_least_squares(problem.r, problem.c, problem.a, problem.b,
                                                problem.g_rows, problem.g);
    ASSERT_TRUE(found);
    expect_optimal(problem, *found);
    active += found->active.size();
  }
  EXPECT_GT(active, 300u) << "problems whose constraints do not bind test nothing";
}

TEST(InequalityLeastSquares, IsTheBestOfAllSubsets) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Problem p(seed);
    const auto found = inequality_least_squares(p.r, p.c, p.a, p.b, p.g_rows, p.g);
    ASSERT_TRUE(found);
    EXPECT_NEAR(p.objective(found->solution.h), least_of_subsets(p), 1e-8 * p.c.squaredNorm())
        << seed;
  }
}

TEST(InequalityLeastSquares, ASignThatTheDataContradictIsZero) {
  const Matrix r = Matrix::Identity(2, 2);
  const auto found =
      inequality_least_squares(r, Eigen::Vector2d(3.0, 1.0), Matrix(0, 2), Vector(),
                               Eigen::RowVector2d(1.0, 0.0), Vector::Zero(1));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->active, std::vector<Index>{0});
  EXPECT_NEAR(found->solution.h[0], 0.0, 1e-15);
  EXPECT_NEAR(found->solution.h[1], 1.0, 1e-15);
  EXPECT_NEAR(found->multipliers[0], 3.0, 1e-12);
  EXPECT_EQ(found->solution.variances[0], 0.0);
}

TEST(InequalityLeastSquares, WhatTheRowsDoNotDetermineSatisfiesThemToo) {
  const Matrix r = Eigen::RowVector2d(1.0, 0.0);
  const auto found =
      inequality_least_squares(r, Vector::Ones(1), Matrix(0, 2), Vector(),
                               Eigen::RowVector2d(0.0, -1.0), Vector::Constant(1, -2.0));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->solution.h[0], 1.0, 1e-7);
  EXPECT_NEAR(found->solution.h[1], 2.0, 1e-7);
}

TEST(InequalityLeastSquares, ContradictionsHaveNoSolution) {
  Matrix rows(2, 1);
  rows << 1.0, -1.0;  // h <= -1 and h >= 1
  EXPECT_FALSE(inequality_least_squares(Matrix::Ones(1, 1), Vector::Ones(1), Matrix(0, 1),
                                        Vector(), rows, Vector::Constant(2, -1.0)));
  EXPECT_THROW(inequality_least_squares(Matrix::Ones(1, 1), Vector::Ones(1), Matrix(0, 1),
                                        Vector(), Matrix::Ones(1, 2), Vector::Ones(1)),
               ArgumentError);
}

}  // namespace
}  // namespace lacuna
