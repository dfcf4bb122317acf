// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/stiff_steps.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lacuna/trajectories/sensitivities/linearised_record.hpp"
#include "support/stiff_models.hpp"
#include "trajectories/sensitivities/linear_step.hpp"
#include "trajectories/sensitivities/secant_slopes.hpp"

namespace lacuna {
namespace {

/// Runge and Kutta's step of order 4 for x' = J x + b, stage by stage.
Vector step_by_stages(const std::array<Matrix, 3>& j, const std::array<Vector, 3>& b,
                      const Vector& x, double h) {
  const Vector k1 = j[0] * x + b[0];
  const Vector k2 = j[1] * (x + 0.5 * h * k1) + b[1];
  const Vector k3 = j[1] * (x + 0.5 * h * k2) + b[1];
  const Vector k4 = j[2] * (x + h * k3) + b[2];
  return x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

TEST(LinearStep, MapsAreThoseOfTheStages) {
  for (const Index m : {1, 2, 3, 5, 9}) {
    std::array<Matrix, 3> j;
    std::array<Vector, 3> b;
    Matrix jacobians(m * m, 3);
    for (std::size_t node = 0; node < 3; ++node) {
      j[node] = Matrix::Random(m, m);
      b[node] = Vector::Random(m);
      jacobians.col(static_cast<Index>(node)) = j[node].reshaped();
    }
    const Vector x = Vector::Random(m);
    LinearStep step;
    step.compute(jacobians, m, 0.3);
    const Vector found =
        step.whole * x + step.first * b[0] + step.middle * b[1] + step.last * b[2];
    EXPECT_LT((found - step_by_stages(j, b, x, 0.3)).norm(), 1e-14) << m;
  }
}

/// v' = -2 v - 3 sign(v), with t.
Rates rubbing() {
  const Variables variables{{"v"}, {}};
  return Rates(OdeModel(
      {{"v", ""}}, {},
      {{{Term::parse("v", variables), -2.0}, {Term::parse("sign(v)", variables), -3.0}}}));
}

TEST(SecantSlopes, AreDerivativesWhereTheModelIsSmooth) {
  const Variables variables{{"x", "y"}, {}};
  Rates rates(OdeModel(
      {{"x", ""}, {"y", ""}}, {},
      {{{Term::parse("x*y", variables), 1.0}}, {{Term::parse("sin(x)", variables), -2.0}}}));
  Matrix slots(300, 3);
  slots.col(0) = Vector::LinSpaced(300, -1.0, 1.0);
  slots.col(1).setConstant(0.7);
  slots.col(2).setZero();
  const auto [slopes, f] =
      secant_slopes(rates, slots, Vector::Zero(300), Vector::Constant(2, 1e-5));
  Matrix expected(300, 2);
  rates.rate(slots, expected);
  EXPECT_EQ(f, expected);
  for (Index i = 0; i < 300; ++i) {
    EXPECT_NEAR(slopes(0, i), 0.7, 1e-9);
    EXPECT_NEAR(slopes(1, i), -2.0 * std::cos(slots(i, 0)), 1e-9);
    EXPECT_NEAR(slopes(2, i), slots(i, 0), 1e-9);
    EXPECT_NEAR(slopes(3, i), 0.0, 1e-9);
  }
}

TEST(SecantSlopes, AJumpActsAsOnAverageOverTheReach) {
  Rates rates = rubbing();
  Matrix slots(2, 2);
  slots << 0.01, 0.0, 0.5, 0.0;
  const Matrix slopes =
      secant_slopes(rates, slots, Vector::Constant(2, 0.1), Vector::Constant(1, 1e-6)).slopes;
  const double reach = 0.5 * 0.1 * (2.0 * 0.01 + 3.0);
  EXPECT_NEAR(slopes(0, 0), -2.0 - 2.0 * 3.0 / (2.0 * reach), 1e-9) << "the jump is in reach";
  EXPECT_NEAR(slopes(0, 1), -2.0, 1e-9) << "and here it is not";
}

TEST(SecantSlopes, TheAccuracyIsTheLeastReach) {
  Rates rates = rubbing();
  Matrix slots(1, 2);
  slots << 0.01, 0.0;
  const Matrix slopes =
      secant_slopes(rates, slots, Vector::Zero(1), Vector::Constant(1, 0.05)).slopes;
  EXPECT_NEAR(slopes(0, 0), -2.0 - 3.0 / 0.05, 1e-9);
}

/// A that turns and decays, different at each node.
Matrix slopes(Index nodes, double decay) {
  Matrix a(4, nodes);
  for (Index i = 0; i < nodes; ++i) {
    const double moved = 1.0 + 0.02 * static_cast<double>(i);
    a.col(i) << -0.2 * moved, -decay, 1.0, -decay * moved;
  }
  return a;
}

TEST(StiffSteps, RespondAsExplicitStepsDoWhereTheseAreStable) {
  const StepGrid grid;
  const Vector length = Vector::Constant(5, 0.1);
  const Matrix a = slopes(grid.rows(6), 3.0);
  EXPECT_FALSE(has_stiff_steps(a, grid, length));
  const StepResponses is = implicit_responses(a, grid, length, 2);
  const StepResponses expected = step_responses(a, grid, length, {2, 16});
  EXPECT_LT((is.transition - expected.transition).norm(), 1e-7);
  EXPECT_LT((is.response - expected.response).norm(), 1e-6);
}

// A rate that is 1 moves what decays fast to where both are in balance: d = -A^-1.
TEST(StiffSteps, RespondToARateByTheBalanceOfWhatDecaysFast) {
  const StepGrid grid;
  const Vector length = Vector::Constant(1, 0.1);
  Matrix a(4, 3);
  a.colwise() = Vector{{-1e6, 0.0, 0.0, -1.0}};
  ASSERT_TRUE(has_stiff_steps(a, grid, length));
  const StepResponses is = implicit_responses(a, grid, length, 2);
  EXPECT_NEAR(is.transition(0, 0), 0.0, 1e-9);
  EXPECT_NEAR(is.transition(3, 0), std::exp(-0.1), 1e-9);
  const Eigen::Map<const Matrix> fast(is.response.col(0).data(), 2, 3);
  EXPECT_NEAR(fast.row(0).sum() * 1e6, 1.0, 1e-6);
  EXPECT_NEAR(fast(0, 2) * 1e6, 1.0, 1e-3) << "of the rate at the end of the step";
}

TEST(StiffSteps, ACompleteStiffModelLeavesNoDefect) {
  if (!Cvode::unavailable().empty()) return;
  for (const support::StiffRecord& one :
       {support::robertson_record(0.0), support::van_der_pol_record(0.0), support::gate()}) {
    const OdeModel model = parse_ode(one.text, "stiff");
    const Trajectory& record = one.data.trajectories.front();
    const Vector range =
        record.states.colwise().maxCoeff() - record.states.colwise().minCoeff();
    const LinearisedRecord linear = linearise(model, record, record.states, 1e-4 * range);
    ASSERT_TRUE(linear.defect.allFinite() && linear.transition.allFinite()) << one.text;
    EXPECT_LT((range.cwiseInverse().asDiagonal() * linear.defect).cwiseAbs().maxCoeff(), 1e-3)
        << one.text;
  }
}

}  // namespace
}  // namespace lacuna
