// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/automatic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "lacuna/dynamics/integration/cvode.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "support/stiff_models.hpp"

namespace lacuna {
namespace {

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
