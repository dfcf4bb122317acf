// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "core/numerics/constrained_least_squares.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

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
    EXPECT_NEAR(p.objective(found->solution.h), least_of_subsets(p),
                1e-8 * p.c.squaredNorm())
        << seed;
  }
}

TEST(InequalityLeastSquares, ASignThatTheDataContradictIsZero) {
  const Matrix r = Matrix::Identity(2, 2);
  const auto found = inequality_least_squares(r, Eigen::Vector2d(3.0, 1.0), Matrix(0, 2),
                                              Vector(), Eigen::RowVector2d(1.0, 0.0),
                                              Vector::Zero(1));
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
