// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/simulate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/dynamics/integration/record_input.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"

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

TEST(Simulate, FollowsTheModel) {
  const OdeModel decay = scalar_model({{"x", -2.0}}, false);
  const Solution solution =
      simulate(decay, Dopri87{}, Vector{{3.0}}, sample_times(1.0, 0.5, 5));
  ASSERT_EQ(solution.states.rows(), 5);
  for (Index i = 0; i < 5; ++i)
    EXPECT_NEAR(solution.states(i, 0), 3.0 * std::exp(-static_cast<double>(i)), 1e-11);
}

TEST(Simulate, InputsDriveTheModel) {
  const OdeModel model = scalar_model({{"u", 1.0}});
  const auto cosine = [](double t, double* u) { *u = std::cos(t); };
  const Solution solution =
      simulate(DrivenModel{model, cosine}, Dopri5{}, Vector{{0.0}}, sample_times(0.0, 0.5, 20));
  for (Index i = 0; i < 20; ++i)
    EXPECT_NEAR(solution.states(i, 0), std::sin(solution.time[i]), 1e-8);
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

TEST(Simulate, MapsAreIterated) {
  const OdeModel map =
      scalar_model({{"x", 3.5}, {"x^2", -3.5}}, false).with_evolution(Evolution::Map);
  const Solution orbit = simulate(map, Rk4{}, Vector{{0.4}}, sample_times(0.0, 0.1, 6));
  double x = 0.4;
  for (Index i = 0; i < 6; ++i, x = 3.5 * x * (1.0 - x))
    EXPECT_NEAR(orbit.states(i, 0), x, 1e-14);
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

}  // namespace
}  // namespace lacuna
