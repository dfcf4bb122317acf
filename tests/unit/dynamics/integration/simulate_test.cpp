// SPDX-License-Identifier: MIT
// Integrators, and simulations along recorded inputs.
#include "lacuna/dynamics/integration/simulate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "dynamics/integration/automatic.hpp"
#include "dynamics/integration/cvode.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"

namespace lacuna {
namespace {

// One state x with input u: dx/dt = sum of the given terms.
OdeModel scalar_model(const std::vector<std::pair<std::string, double>>& terms,
                      bool with_input = true) {
  const std::vector<Quantity> inputs =
      with_input ? std::vector<Quantity>{{"u", "V"}} : std::vector<Quantity>{};
  Variables variables{{"x"}, {}};
  if (with_input) variables.inputs = {"u"};
  Equation equation;
  for (const auto& [term, coefficient] : terms)
    equation.push_back({Term::parse(term, variables), coefficient, {}, {}});
  return OdeModel({{"x", "V"}}, inputs, {equation}, "ms");
}

/// dx/dt = -2 x + u with u held: x goes to u/2 by exp(-2 h) in each interval.
TEST(Simulate, StepsEndWhereAnInputJumps) {
  const OdeModel model = scalar_model({{"x", -2.0}, {"u", 1.0}});
  const Vector jumps{{0.0, 0.13, 0.61, 0.97}}, levels{{1.0, -3.0, 2.0, 0.0}};
  RecordInput input(jumps, levels, Interpolation::Held);
  double expected = 0.7, t = 0.0;
  const auto hold = [&](double level, double until) {
    expected = 0.5 * level + (expected - 0.5 * level) * std::exp(-2.0 * (until - t));
    t = until;
  };
  for (Index i = 0; i < 3; ++i) hold(levels[i], jumps[i + 1]);
  hold(levels[3], 1.25);
  const Vector times = sample_times(0.0, 0.25, 6);
  const auto last = [&](const Vector& breaks) {
    return simulate(DrivenModel{model, input, breaks}, Rk4{{.substeps = 40}}, Vector{{0.7}},
                    times)
        .states(5, 0);
  };
  EXPECT_NEAR(last(input.breaks()), expected, 1e-10);
  EXPECT_GT(std::abs(last(Vector()) - expected), 1e-6) << "steps across a jump are not exact";
}

TEST(Simulate, DelayedInputsJumpLater) {
  const OdeModel model = scalar_model({{"delay(u,0.2)", 1.0}});
  RecordInput input(Vector{{0.0, 0.13, 0.61}}, Vector{{1.0, -3.0, 2.0}}, Interpolation::Held);
  const Solution solution = simulate(DrivenModel{model, input, input.breaks()}, Rk4{},
                                     Vector{{0.0}}, sample_times(0.0, 0.25, 5));
  EXPECT_NEAR(solution.states(4, 0), 0.33 * 1.0 - 3.0 * 0.48 + 2.0 * 0.19, 1e-12);
}

// dx/dt = -x(t-1) with x = 1 before 0, by the method of steps.
double delayed_decay(double t) {
  double value = 1.0 - t;
  if (t > 1.0) value += std::pow(t - 1.0, 2) / 2.0;
  if (t > 2.0) value -= std::pow(t - 2.0, 3) / 6.0;
  if (t > 3.0) value += std::pow(t - 3.0, 4) / 24.0;
  return value;
}

TEST(Simulate, DelayedStatesComeFromTheOrbit) {
  const OdeModel model = scalar_model({{"delay(x,1)", -1.0}}, false);
  for (const double h : {0.1, 0.5, 2.0}) {  // also steps longer than the delay
    const auto samples = static_cast<Index>(4.0 / h) + 1;
    const Solution solution =
        simulate(model, Rk4{}, Vector{{1.0}}, sample_times(0.0, h, samples));
    for (Index i = 0; i < samples; ++i)
      EXPECT_NEAR(solution.states(i, 0), delayed_decay(solution.time[i]), 1e-4)
          << "t = " << solution.time[i] << ", h = " << h;
  }
}

TEST(Simulate, TinyDelayIsNearlyNone) {
  const OdeModel model = scalar_model({{"delay(x,1e-7)", -1.0}}, false);
  const Solution solution = simulate(model, Rk4{}, Vector{{1.0}}, sample_times(0.0, 0.5, 5));
  ASSERT_EQ(solution.status, IntegrationStatus::Completed);
  EXPECT_NEAR(solution.states(4, 0), std::exp(-2.0), 1e-5);
}

TEST(Simulate, DivergenceNamesStatesAndUnit) {
  const OdeModel model = scalar_model({{"x^2", 1.0}}, false);
  const Solution solution =
      simulate(model, Dopri5{}, Vector{{1.0}}, sample_times(0.0, 0.1, 30));
  EXPECT_EQ(solution.status, IntegrationStatus::Diverged);
  EXPECT_THAT(solution.message, testing::MatchesRegex("diverged at t = 1 ms with x = .*"));
}

TEST(Simulate, ArgumentsAreChecked) {
  const OdeModel driven = scalar_model({{"u", 1.0}});
  const OdeModel free = scalar_model({{"x", 1.0}}, false);
  const Vector times = sample_times(0.0, 0.1, 3);
  EXPECT_THROW(simulate(driven, Rk4{}, Vector{{0.0}}, times), ArgumentError);
  EXPECT_THROW(simulate(free, Rk4{}, Vector{{0.0, 0.0}}, times), ArgumentError);
}

TEST(SampleTimes, DoNotAccumulateRounding) {
  const Vector times = sample_times(1.0, 0.1, 100001);
  EXPECT_EQ(times[0], 1.0);
  EXPECT_EQ(times[100000], 10001.0);
}

TEST(Simulate, MapsTakeInputsAndTimeAtTheSampleBefore) {
  const OdeModel map =
      scalar_model({{"x", 0.5}, {"u", 1.0}, {"t", 2.0}}).with_evolution(Evolution::Map);
  RecordInput input(Vector{{0.0, 1.0, 2.0, 3.0}}, Vector{{5.0, -1.0, 7.0, 9.0}},
                    Interpolation::Held);
  const Solution orbit = simulate(DrivenModel{map, input, input.breaks()}, Rk4{}, Vector{{0.0}},
                                  sample_times(0.0, 1.0, 4));
  EXPECT_EQ(orbit.states(1, 0), 5.0);
  EXPECT_EQ(orbit.states(2, 0), 2.5 - 1.0 + 2.0);
  EXPECT_EQ(orbit.states(3, 0), 1.75 + 7.0 + 4.0);
}

TEST(Simulate, MapsThatDivergeSaySo) {
  const OdeModel map = scalar_model({{"x^2", 1.0}}, false).with_evolution(Evolution::Map);
  const Solution orbit = simulate(map, Rk4{}, Vector{{10.0}}, sample_times(0.0, 1.0, 20));
  EXPECT_EQ(orbit.status, IntegrationStatus::Diverged);
  EXPECT_EQ(orbit.time.size(), 4);  // 10, 1e2, 1e4, 1e8
}

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

Trajectory sine(Index n, double h) {
  Trajectory trajectory;
  trajectory.time = Vector::LinSpaced(n, 0.0, h * static_cast<double>(n - 1));
  trajectory.inputs.resize(n, 2);
  trajectory.inputs.col(0) = trajectory.time.array().sin();
  trajectory.inputs.col(1) = trajectory.time.array().cos();
  return trajectory;
}

double worst_error(RecordInput input, double end) {
  double worst = 0.0;
  for (double t = 0.0; t <= end; t += 0.0137) {
    double u[2];
    input(t, u);
    worst = std::max({worst, std::abs(u[0] - std::sin(t)), std::abs(u[1] - std::cos(t))});
  }
  return worst;
}

TEST(RecordInput, IsQuinticUnlessToldOtherwise) {
  const double coarse = worst_error(RecordInput(sine(51, 0.2)), 10.0);
  const double fine = worst_error(RecordInput(sine(101, 0.1)), 10.0);
  EXPECT_NEAR(std::log2(coarse / fine), 6.0, 0.4);
}

TEST(RecordInput, OnePointHoldsTheLastSample) {
  RecordInput input(Vector{{0.0, 1.0, 3.0}}, Vector{{5.0, 6.0, 7.0}}, Interpolation::Held);
  double u = 0.0;
  input(0.99, &u);
  EXPECT_EQ(u, 5.0);
  input(1.0, &u);
  EXPECT_EQ(u, 6.0);
  input(3.0, &u);
  EXPECT_EQ(u, 7.0);
}

TEST(RecordInput, EachInputGoesOnInItsOwnWay) {
  Trajectory run = sine(51, 0.2);
  const std::vector<Quantity> inputs{{"a", "", Hold::Zero}, {"b", ""}};
  RecordInput input(run, inputs);
  double u[2];
  input(1.1, u);
  EXPECT_EQ(u[0], run.inputs(5, 0));
  EXPECT_NEAR(u[1], std::cos(1.1), 1e-4);
  EXPECT_EQ(input.breaks(), run.time);
  EXPECT_EQ(RecordInput(run).breaks().size(), 0) << "smooth inputs have no breaks";
}

TEST(RecordInput, ShapesMustFit) {
  EXPECT_THROW(RecordInput(Vector{{0.0, 1.0}}, Matrix::Zero(3, 1)), ArgumentError);
  EXPECT_THROW(RecordInput(sine(51, 0.2), std::vector<Quantity>{{"a", ""}}), ArgumentError);
}

}  // namespace
}  // namespace lacuna
