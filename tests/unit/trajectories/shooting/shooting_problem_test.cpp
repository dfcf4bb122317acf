// SPDX-License-Identifier: MIT
// Elimination of initial states and the step against dense least squares that has them as
// unknowns.
#include "trajectories/shooting/shooting_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "unit/trajectories/shooting/dense_problem.hpp"

namespace lacuna {
namespace {

using testing::dense_problem;
using testing::DenseProblem;
using testing::ShootingCase;

/// Solution of the dense problem with rows damping * D below it.
Vector dense_step(const DenseProblem& dense, const Vector& damping) {
  const Index n = dense.jacobian.rows(), u = dense.jacobian.cols();
  Matrix rows = Matrix::Zero(n + u, u);
  rows.topRows(n) = dense.jacobian;
  rows.bottomRows(u) = damping.asDiagonal();
  Vector target = Vector::Zero(n + u);
  target.head(n) = dense.residual;
  return rows.householderQr().solve(target);
}

/// Damping of each unknown: norms of the columns, of parameters without initial states.
Vector damping_of(const DenseProblem& dense, double damping) {
  Vector sizes = dense.jacobian.colwise().norm();
  sizes.tail(dense.parameters()) =
      dense.without_starts(dense.jacobian.rightCols(dense.parameters())).colwise().norm();
  return damping * sizes;
}

TEST(ShootingProblem, WindowsAreTheRowsOfTheDenseProblem) {
  ShootingCase c;
  ASSERT_EQ(c.plan.size(), 5u);
  const DenseProblem dense = dense_problem(c.problem, c.plan, c.point);
  const ShootingLinearisation linear = c.problem.linearise(c.plan, c.point);
  const Index n = c.problem.record().samples(), p = dense.parameters();
  for (std::size_t w = 0; w < c.plan.size(); ++w) {
    Matrix rows(2 * c.plan[w].samples, 2 + p + 1);
    for (Index q = 0; q < 2; ++q) {
      const auto own = Eigen::seqN(q * n + c.plan[w].first, c.plan[w].samples);
      auto part = rows.middleRows(q * c.plan[w].samples, c.plan[w].samples);
      part.leftCols(2) =
          dense.jacobian(own, Eigen::all).middleCols(2 * static_cast<Index>(w), 2);
      part.middleCols(2, p) = dense.jacobian(own, Eigen::all).rightCols(p);
      part.col(2 + p) = dense.residual(own);
    }
    const Matrix gram = rows.transpose() * rows;
    const Matrix& triangle = linear.windows[w];
    EXPECT_LT((triangle.transpose() * triangle - gram).norm(), 1e-6 * gram.norm()) << w;
  }
}

TEST(ShootingProblem, StepIsThatOfTheDenseProblem) {
  ShootingCase c;
  const DenseProblem dense = dense_problem(c.problem, c.plan, c.point);
  const ShootingLinearisation linear = c.problem.linearise(c.plan, c.point);
  for (const double damping : {0.0, 0.3, 3.0}) {
    const BlockStep step = solve_blocks(linear.triangles(), 2, damping);
    const Vector expected = dense_step(dense, damping_of(dense, damping));
    EXPECT_LT((step.common - expected.tail(dense.parameters())).norm(),
              1e-5 * expected.tail(dense.parameters()).norm())
        << damping;
    EXPECT_LT((step.own.transpose().reshaped() - expected.head(dense.starts)).norm(),
              1e-5 * expected.head(dense.starts).norm())
        << damping;
    const Vector left = dense.residual - dense.jacobian * expected;
    EXPECT_NEAR(step.decrease, dense.residual.squaredNorm() - left.squaredNorm(),
                1e-5 * step.decrease)
        << damping;
  }
}

TEST(ShootingProblem, HubersLossIsLinearOutside) {
  constexpr double kHuber = 0.2;
  ShootingCase c(kHuber);
  const Matrix r = c.problem.residuals(c.plan, c.point);
  const Matrix weights = c.problem.row_weights(c.point);
  const Prior prior = *c.problem.model().priors()[0];
  double cost = std::pow((prior.value - c.point.parameters[0]) / prior.tolerance, 2);
  Index outside = 0;
  for (Index q = 0; q < 2; ++q)
    for (Index i = 0; i < r.rows(); ++i) {
      const double size = std::abs(r(i, q)), sigma = c.problem.sigma()[q];
      outside += size > kHuber ? 1 : 0;
      cost += size > kHuber ? 2.0 * kHuber * size - kHuber * kHuber : size * size;
      const double weight = size > kHuber ? kHuber / size : 1.0;
      EXPECT_NEAR(std::pow(weights(i, q) * sigma, 2), weight, 1e-12);
    }
  ASSERT_GT(outside, 5);
  EXPECT_NEAR(c.point.cost, cost, 1e-9 * cost);
}

TEST(ShootingProblem, StatesWithoutAColumnHaveNoRows) {
  ShootingCase c({}, testing::without_states(testing::two_records(), 1, 1));
  c.point.starts.col(1).setConstant(0.4);
  c.problem.evaluate(c.plan, c.point);
  const DenseProblem dense = dense_problem(c.problem, c.plan, c.point);
  EXPECT_EQ(dense.residual.size(), 41 + 1);
  const ShootingLinearisation linear = c.problem.linearise(c.plan, c.point);
  const BlockStep step = solve_blocks(linear.triangles(), 2, 0.3);
  const Vector expected = dense_step(dense, damping_of(dense, 0.3));
  EXPECT_LT((step.common - expected.tail(dense.parameters())).norm(),
            1e-4 * expected.tail(dense.parameters()).norm());
}

TEST(ShootingProblem, DirectionsThatAreNotDeterminedGetNothing) {
  const Matrix triangle = Matrix{{2.0, 4.0, 1.0}, {0.0, 0.0, 1.0}, {0.0, 0.0, 3.0}};
  const Vector solution = solve_determined(triangle, Vector{{5.0, 1.0, 3.0}});
  EXPECT_TRUE(solution[0] == 0.0 || solution[1] == 0.0);
  EXPECT_NEAR(solution[2], 1.0, 1e-12);
  EXPECT_NEAR(2.0 * solution[0] + 4.0 * solution[1], 4.0, 1e-12);
  const Matrix scales = Matrix{{1e-9, 2.0}, {0.0, 1e9}};
  EXPECT_LT((scales * solve_determined(scales, Vector{{1.0, 1.0}}) - Vector::Ones(2)).norm(),
            1e-9);
}

TEST(ShootingProblem, CovarianceIsTheInverseOfTheNormalEquations) {
  const Matrix triangle = Matrix{{2e-6, 1e-6, 3.0}, {0.0, 5.0, -1.0}, {0.0, 0.0, 0.1}};
  const Matrix covariance = covariance_of(triangle);
  const Matrix identity = triangle * covariance * triangle.transpose();
  EXPECT_LT((identity - Matrix::Identity(3, 3)).norm(), 1e-9);
  EXPECT_FALSE(covariance_of(Matrix{{1.0, 2.0}, {0.0, 1e-13}}).allFinite());
}

}  // namespace
}  // namespace lacuna
