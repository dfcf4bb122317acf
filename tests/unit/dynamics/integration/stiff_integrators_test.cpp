// SPDX-License-Identifier: MIT
// Integrators of stiff models.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/automatic.hpp"
#include "lacuna/dynamics/integration/cvode.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "support/stiff_models.hpp"

namespace lacuna {
namespace {

/// Robertson's reactions (1966), the standard stiff problem: rates 0.04, 1e4 and 3e7.
constexpr auto robertson = [](double, const double* x, double* dxdt) {
  dxdt[0] = -0.04 * x[0] + 1e4 * x[1] * x[2];
  dxdt[2] = 3e7 * x[1] * x[1];
  dxdt[1] = -dxdt[0] - dxdt[2];
};

bool is_absent() {
  if (Cvode::unavailable().empty()) return false;
  EXPECT_THROW(Cvode().make_stepper(1), ConfigError);
  return true;
}

// Hairer and Wanner, Solving Ordinary Differential Equations II, give x at t = 40; at 1e5 the
// slow manifold, where x2 is in balance, is what is left: 0.04 x1 = 1e4 x2 x3 + 3e7 x2^2.
TEST(Cvode, SolvesRobertsonsReactionsTo1e5Seconds) {
  if (is_absent()) return;
  const Vector times{{0.0, 40.0, 1e5}};
  const Solution orbit = Cvode().integrate(robertson, Vector{{1.0, 0.0, 0.0}}, times);
  ASSERT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  EXPECT_NEAR(orbit.states(1, 0), 0.7158270688, 1e-7);
  EXPECT_NEAR(orbit.states(1, 1), 0.9185534764e-5, 1e-11);
  EXPECT_NEAR(orbit.states(2, 0) + orbit.states(2, 1) + orbit.states(2, 2), 1.0, 1e-9);
  const double x1 = orbit.states(2, 0), x2 = orbit.states(2, 1), x3 = orbit.states(2, 2);
  EXPECT_NEAR(0.04 * x1 / (1e4 * x2 * x3 + 3e7 * x2 * x2), 1.0, 1e-4);
}

// What it is for: an explicit method needs steps of the fastest time everywhere.
TEST(Cvode, TakesFarFewerRatesThanAnExplicitMethod) {
  if (is_absent()) return;
  long rates = 0;
  const auto counted = [&](double t, const double* x, double* dxdt) {
    ++rates;
    robertson(t, x, dxdt);
  };
  const Vector start{{1.0, 0.0, 0.0}}, times{{0.0, 40.0}};
  const Solution implicit_orbit = Cvode().integrate(counted, start, times);
  const long taken = std::exchange(rates, 0);
  const Solution explicit_orbit = Dopri5().integrate(counted, start, times);
  EXPECT_EQ(explicit_orbit.status, IntegrationStatus::Completed);
  EXPECT_LT((implicit_orbit.end_state - explicit_orbit.end_state).norm(), 1e-7);
  EXPECT_LT(50 * taken, rates);
}

TEST(Cvode, GoesOnWhereACallerMovedTheState) {
  if (is_absent()) return;
  const auto decay = [](double, const double* x, double* dxdt) { dxdt[0] = -x[0]; };
  const auto stepper = Cvode().make_stepper(1);
  double t = 0.0, x = 1.0;
  ASSERT_EQ(stepper->advance(decay, t, 1.0, &x), IntegrationStatus::Completed);
  EXPECT_NEAR(x, std::exp(-1.0), 1e-7);
  x = 5.0;
  ASSERT_EQ(stepper->advance(decay, t, 3.0, &x), IntegrationStatus::Completed);
  EXPECT_NEAR(x, 5.0 * std::exp(-2.0), 1e-6);
  EXPECT_EQ(t, 3.0);
}

// Without CVODE explicit steps go on, and give up.
TEST(Automatic, GoesOnByImplicitStepsWhereTheModelIsStiff) {
  const Vector times{{0.0, 40.0, 1e5}}, start{{1.0, 0.0, 0.0}};
  const OdeModel model = support::robertson();
  const Solution orbit = simulate(model, Automatic(), start, times);
  if (!Cvode::unavailable().empty()) {
    EXPECT_EQ(orbit.status, IntegrationStatus::StepTooSmall);
    return;
  }
  ASSERT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  EXPECT_NEAR(orbit.states(1, 0), 0.7158270688, 1e-7) << "Hairer and Wanner's value";
  EXPECT_NEAR(orbit.states.row(2).sum(), 1.0, 1e-8);
  EXPECT_EQ(simulate(model, Dopri5(), start, times).status, IntegrationStatus::StepTooSmall)
      << "explicit steps alone are too many";
}

TEST(Automatic, FindsStiffnessWithoutASampleWhereItBegins) {
  if (!Cvode::unavailable().empty()) return;
  const Vector times{{0.0, 2e4, 1e5}}, start{{1.0, 0.0, 0.0}};
  const Solution orbit = simulate(support::robertson(), Automatic(), start, times);
  ASSERT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  EXPECT_NEAR(orbit.states.row(2).sum(), 1.0, 1e-8);
}

TEST(Automatic, IsDopri5ToTheBitWhereTheModelIsNotStiff) {
  long rates = 0;
  const auto lorenz = [&rates](double, const double* x, double* dxdt) {
    ++rates;
    dxdt[0] = 10.0 * (x[1] - x[0]);
    dxdt[1] = x[0] * (28.0 - x[2]) - x[1];
    dxdt[2] = x[0] * x[1] - 8.0 / 3.0 * x[2];
  };
  const Vector start{{1.0, 1.0, 20.0}}, times = sample_times(0.0, 0.1, 300);
  const Solution automatic = Automatic().integrate(lorenz, start, times);
  const long taken = std::exchange(rates, 0);
  EXPECT_EQ(automatic.states, Dopri5().integrate(lorenz, start, times).states);
  EXPECT_EQ(taken, rates);
  EXPECT_GT(taken, 20000) << "enough steps to be tested for stiffness many times";
}

TEST(Automatic, FollowsAGateWithNanosecondsAndMilliseconds) {
  if (!Cvode::unavailable().empty()) return;
  const support::StiffRecord gate = support::gate();
  // The output is the input's inverse within nanoseconds; the slow state is a low-pass of it.
  const Matrix& x = gate.data.trajectories.front().states;
  EXPECT_NEAR(x(5, 0), 1.0, 1e-6);
  EXPECT_NEAR(x(5, 1), 1.0 - std::exp(-5.0 * 1e-5 / 1e-3), 1e-4);
}

// Held while |1.2 cos(0.7 t)| < 0.5 at rest; else the sign of the velocity is that of the force.
TEST(Automatic, RestsOnDryFrictionAndSlipsAgain) {
  const auto swinging = [](double t, const double* x, double* dxdt) {
    const double sign = x[1] > 0.0 ? 1.0 : x[1] < 0.0 ? -1.0 : 0.0;
    dxdt[0] = x[1];
    dxdt[1] = -25.0 * std::sin(x[0]) - 0.2 * x[1] + 1.2 * std::cos(0.7 * t) - 0.5 * sign;
  };
  const Vector start{{0.4, 0.0}}, times = sample_times(0.0, 0.01, 2001);
  const Solution orbit = Automatic().integrate(swinging, start, times);
  ASSERT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  const Solution fixed = Rk4({.substeps = 100}).integrate(swinging, start, times);
  EXPECT_LT((orbit.states - fixed.states).cwiseAbs().maxCoeff(), 5e-4);
}

}  // namespace
}  // namespace lacuna
