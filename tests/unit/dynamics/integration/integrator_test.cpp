// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/integrator.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "lacuna/dynamics/integration/automatic.hpp"
#include "lacuna/dynamics/integration/cvode.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"

namespace lacuna {
namespace {

constexpr auto oscillator = [](double, const double* x, double* dxdt) {
  dxdt[0] = x[1];
  dxdt[1] = -x[0];
};

constexpr auto not_a_number = [](double t, const double* x, double* dxdt) {
  dxdt[0] = std::sqrt(0.5 - t) * x[0];
};

Vector times(double h, Index n) {
  return Vector::LinSpaced(n, 0.0, h * static_cast<double>(n - 1));
}

std::vector<Stage<Integrator>> integrators() {
  return {Rk4{{.substeps = 4}}, Dopri5{}, Dopri8{{.substeps = 4}}, Dopri87{}};
}

TEST(Integrator, NotANumberIsDivergence) {
  ASSERT_FALSE(integrators().empty());
  for (const auto& integrator : integrators()) {
    const Solution solution =
        integrator->integrate(not_a_number, Vector{{1.0}}, times(0.1, 21));
    EXPECT_NE(solution.status, IntegrationStatus::Completed) << integrator->info().name;
    EXPECT_LE(solution.end_time, 0.5);
    EXPECT_TRUE(solution.states.allFinite());
  }
}

TEST(Integrator, NoSampleBeyondTheBoundIsKept) {
  const auto growth = [](double, const double* x, double* dxdt) { dxdt[0] = 10.0 * x[0]; };
  const Solution solution = Dopri5{}.integrate(growth, Vector{{1.0}}, times(0.1, 101));
  EXPECT_EQ(solution.status, IntegrationStatus::Diverged);
  EXPECT_LE(solution.states.maxCoeff(), 1e12);
  EXPECT_NEAR(solution.end_time, std::log(1e12) / 10.0, 0.1);
}

TEST(Integrator, BoundFollowsTheInitialState) {
  const Vector x0{{1.0, -3e5}};
  EXPECT_EQ(divergence_bound(x0.data(), 2), 3e17);
  EXPECT_EQ(divergence_bound(x0.data(), 1), 1e12);
}

TEST(Integrator, ArgumentsAreChecked) {
  const Rk4 rk4;
  const Vector x0{{1.0, 0.0}};
  EXPECT_THROW(rk4.integrate(oscillator, x0, Vector{{0.0, 1.0, 1.0}}), ArgumentError);
  EXPECT_THROW(rk4.integrate(oscillator, x0, Vector{{0.0, 1.0, 0.5}}), ArgumentError);
  EXPECT_THROW(rk4.integrate(oscillator, x0, Vector()), ArgumentError);
  EXPECT_THROW(rk4.integrate(oscillator, Vector{{1.0, std::nan("")}}, Vector{{0.0, 1.0}}),
               ArgumentError);
  EXPECT_THROW(rk4.integrate(oscillator, Vector(), Vector{{0.0, 1.0}}), ArgumentError);
}

TEST(Integrator, StopRequestEndsTheRun) {
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  EXPECT_THROW(Rk4{}.integrate(oscillator, Vector{{1.0, 0.0}}, times(0.1, 10), context),
               Cancelled);
}

/// Between two samples there may be any number of steps.
TEST(Integrator, ADeadlineEndsARunBetweenTwoSamples) {
  std::vector<Stage<Integrator>> adaptive{Dopri5{}, Automatic{}};
  if (Cvode::unavailable().empty()) adaptive.emplace_back(Cvode{});
  for (const auto& integrator : adaptive) {
    RunContext context;
    int evaluations = 0;
    const auto rates = [&](double t, const double* x, double* dxdt) {
      if (++evaluations == 1000) context.deadline = std::chrono::steady_clock::now();
      oscillator(t, x, dxdt);
    };
    EXPECT_THROW(integrator->integrate(rates, Vector{{1.0, 0.0}}, Vector{{0.0, 1e4}}, context),
                 OutOfTime)
        << integrator->info().name;
    EXPECT_LT(evaluations, 2000) << integrator->info().name;
  }
}

}  // namespace
}  // namespace lacuna
