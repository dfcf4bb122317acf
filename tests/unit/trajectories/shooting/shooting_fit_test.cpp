// SPDX-License-Identifier: MIT
#include "trajectories/shooting/shooting_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "trajectories/shooting/shooting_problem.hpp"
#include "unit/trajectories/shooting/dense_problem.hpp"

namespace lacuna {
namespace {

using testing::dense_problem;
using testing::DenseProblem;
using testing::ShootingCase;

// Elimination of initial states and the step against dense least squares that has them as
// unknowns.
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

/// dx/dt = -a x over 20 samples, x(0) = 2, with noise.
ShootingProblem decay_problem(double a, double noise) {
  const Variables variables{{"x"}, {}};
  const OdeModel model({{"x", ""}}, {}, {{{Term::parse("x", variables), -a}}});
  Dataset data;
  data.states = {{"x", ""}};
  Trajectory run{.source = "decay.csv",
                 .time = Vector::LinSpaced(20, 0.0, 1.9),
                 .states = {},
                 .inputs = Matrix(20, 0),
                 .derivatives = {}};
  Random random(2);
  run.states.resize(20, 1);
  for (Index i = 0; i < 20; ++i)
    run.states(i, 0) = 2.0 * std::exp(-1.3 * run.time[i]) + noise * random.normal();
  data.trajectories.push_back(run);
  return {with_free_coefficients(model), data, std::nullopt};
}

TEST(ShootingFit, FindsTheLeastSquaresOfAnExponential) {
  ShootingProblem problem = decay_problem(0.5, 0.1);
  problem.set_scheme({&prince_dormand_87(), 2});
  ShootingFit fit;
  fit.plan = equal_windows(problem.record().begins, 20);
  fit.point.parameters = problem.model().values();
  fit.point.starts = Matrix::Constant(1, 1, 1.0);
  minimise(problem, fit, 1e-12, 50, {});
  // The best factor of exp(-a t) is a linear problem; a by a fine scan.
  const Vector y = problem.record().values.col(0), t = problem.record().time;
  double least = 1e300, best = 0.0;
  for (double a = 0.8; a < 2.0; a += 1e-5) {
    const Vector e = (-a * t.array()).exp();
    const double left = y.squaredNorm() - std::pow(e.dot(y), 2) / e.squaredNorm();
    if (left < least) best = a;
    least = std::min(least, left);
  }
  EXPECT_NEAR(-fit.point.parameters[0], best, 2e-5);
  EXPECT_NEAR(fit.point.cost, least, 1e-8);
}

TEST(ShootingFit, ResidualSigmaCountsWhatTheFitTook) {
  ShootingCase c;
  const ShootingFit fit{c.plan, c.point, {}};
  const Matrix r = c.problem.residuals(c.plan, c.point);
  const Vector even = residual_sigma(c.problem, fit, false);
  EXPECT_NEAR(even[0], 0.1 * r.col(0).norm() / std::sqrt(69.0 / 2.0), 1e-12);
  EXPECT_NEAR(even[1], 0.2 * r.col(1).norm() / std::sqrt(69.0 / 2.0), 1e-12);
  const Vector taken = residual_sigma(c.problem, fit, false, Vector{{9.0, 4.0}});
  EXPECT_NEAR(taken[0], 0.1 * r.col(0).norm() / std::sqrt(41.0 - 9.0), 1e-12);
  EXPECT_NEAR(taken[1], 0.2 * r.col(1).norm() / std::sqrt(41.0 - 4.0), 1e-12);
  std::vector<double> sizes;
  for (const double value : r.col(1)) sizes.push_back(std::abs(value));
  std::sort(sizes.begin(), sizes.end());
  const double median = sizes[20] / 0.6744897501960817;  // that of |normal| is 0.6745
  EXPECT_NEAR(residual_sigma(c.problem, fit, true, Vector{{9.0, 4.0}})[1],
              0.2 * median * std::sqrt(41.0 / 37.0), 1e-12);
}

TEST(ShootingFit, StepsAreAsFineAsTheNoiseAsks) {
  ShootingProblem problem = decay_problem(1.3, 0.0);
  const WindowPlan plan = equal_windows(problem.record().begins, 20);
  ShootingPoint point{problem.model().values(), Matrix::Constant(1, 1, 2.0)};
  const StepScheme before = problem.scheme();
  const Vector exact = 2.0 * (-1.3 * problem.record().time.array()).exp();
  int last_order = 0;
  for (const double sigma : {1e-2, 1e-8, 1e-11}) {
    const StepScheme scheme = accurate_scheme(problem, plan, point, Vector::Constant(1, sigma));
    EXPECT_EQ(problem.scheme(), before) << "the problem is left as it was";
    problem.set_scheme(scheme);
    problem.evaluate(plan, point);
    EXPECT_LT((point.orbits.samples.col(0) - exact).norm(), 0.15 * sigma);
    EXPECT_GE(scheme.tableau->order, last_order);
    last_order = scheme.tableau->order;
    problem.set_scheme(before);
  }
  EXPECT_EQ(accurate_scheme(problem, plan, point, Vector::Ones(1)),
            (StepScheme{&runge_kutta_4(), 1}));
}

TEST(ShootingFit, AMethodThatIsNoBetterThanTheLastOneIsNotTheEndOfTheLadder) {
  // At steps of some time constants the fifth order may be no better than the fourth.
  for (double a = 2.0; a < 60.0; a += 1.0) {
    ShootingProblem problem = decay_problem(a, 0.0);
    const WindowPlan plan = equal_windows(problem.record().begins, 20);
    ShootingPoint point{problem.model().values(), Matrix::Constant(1, 1, 2.0)};
    const double sigma = 1e-4;
    problem.set_scheme(accurate_scheme(problem, plan, point, Vector::Constant(1, sigma)));
    problem.evaluate(plan, point);
    const Vector exact = 2.0 * (-a * problem.record().time.array()).exp();
    EXPECT_LT((point.orbits.samples.col(0) - exact).norm(), 0.15 * sigma) << a;
  }
}

TEST(ShootingFit, WhereRatesJumpNoFinerSchemeIsTaken) {
  const Variables variables{{"x"}, {}};
  const OdeModel model(
      {{"x", ""}}, {},
      {{{Term::parse("sign(x)", variables), -1.0}, {Term::parse("1", variables), 0.3}}});
  ShootingProblem smooth = decay_problem(1.3, 0.0);
  Dataset data;
  data.states = {{"x", ""}};
  data.trajectories.push_back({.source = "jump.csv",
                               .time = smooth.record().time,
                               .states = smooth.record().values,
                               .inputs = Matrix(20, 0),
                               .derivatives = {}});
  ShootingProblem problem(with_free_coefficients(model), data, std::nullopt);
  const WindowPlan plan = equal_windows(problem.record().begins, 20);
  const ShootingPoint point{problem.model().values(), Matrix::Constant(1, 1, 2.0)};
  const StepScheme scheme = accurate_scheme(problem, plan, point, Vector::Constant(1, 1e-9));
  EXPECT_LE(scheme.tableau->order, 5);
  EXPECT_EQ(scheme.substeps, 1);
}

}  // namespace
}  // namespace lacuna
