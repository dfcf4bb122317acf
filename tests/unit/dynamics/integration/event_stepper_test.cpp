// SPDX-License-Identifier: MIT
#include "dynamics/integration/event_stepper.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

/// Amount in the blood of one compartment with absorption from the gut, a time behind a dose.
double after_dose(double dose, double ka, double k, double t) {
  return t < 0.0 ? 0.0 : dose * ka / (ka - k) * (std::exp(-k * t) - std::exp(-ka * t));
}

TEST(Events, RepeatedDosesAreSuperposed) {
  const OdeModel model = parse_ode(
      "dgut/dt = -1.3*gut\ndx/dt = 1.3*gut - 0.2*x\n"
      "at 0.25: gut += 50\nevery 12 from 6 until 40: gut += 100\n",
      "m.ode");
  const Solution run =
      simulate(model, Dopri87{}, Vector::Zero(2), sample_times(0.0, 0.75, 80));
  ASSERT_EQ(run.status, IntegrationStatus::Completed);
  for (Index i = 0; i < run.time.size(); ++i) {
    double expected = after_dose(50.0, 1.3, 0.2, run.time[i] - 0.25);
    for (const double dose : {6.0, 18.0, 30.0})
      expected += after_dose(100.0, 1.3, 0.2, run.time[i] - dose);
    EXPECT_NEAR(run.states(i, 1), expected, 1e-8);
  }
}

TEST(Events, SampleAtAnEventIsBehindIt) {
  const OdeModel model = parse_ode("dx/dt = 0\nat 0: x += 2\nevery 0.1 from 0.3: x += 1\n", "m");
  const Solution run = simulate(model, Dopri5{}, Vector::Zero(1), sample_times(0.0, 0.1, 8));
  const std::vector<double> expected{2, 2, 2, 3, 4, 5, 6, 7};
  for (Index i = 0; i < 8; ++i)
    EXPECT_DOUBLE_EQ(run.states(i, 0), expected[static_cast<std::size_t>(i)]) << i;
}

/// Height of a ball that falls from 1 and keeps a fraction of its speed at the floor.
double height_of_ball(double t, double keeps, double g) {
  double begin = -std::sqrt(2.0 / g), speed = std::sqrt(2.0 * g);  // as if thrown up to 1
  for (;;) {
    const double flight = 2.0 * speed / g;
    if (t < begin + flight) return (t - begin) * (speed - 0.5 * g * (t - begin));
    begin += flight;
    speed *= keeps;
  }
}

TEST(Events, BallBouncesAtTheAnalyticTimes) {
  const OdeModel model = parse_ode(
      "dh/dt = v\ndv/dt = -9.81\nwhen h < 0: v *= -0.8\n", "m.ode");
  const Vector start = (Vector(2) << 1.0, 0.0).finished();
  for (const double step : {0.01, 0.4}) {  // several samples in a flight; longer than some
    const Solution run = simulate(model, Dopri87{}, start,
                                  sample_times(0.0, step, static_cast<Index>(3.0 / step)));
    ASSERT_EQ(run.status, IntegrationStatus::Completed) << run.message;
    for (Index i = 0; i < run.time.size(); ++i)
      EXPECT_NEAR(run.states(i, 0), height_of_ball(run.time[i], 0.8, 9.81), 1e-8)
          << run.time[i];
  }
}

TEST(Events, BallThatComesToRestEndsTheSimulation) {
  const OdeModel model =
      parse_ode("dh/dt = v\ndv/dt = -9.81\nwhen h < 0: v *= -0.5\n", "m.ode");
  const Solution run = simulate(model, Dopri5{}, (Vector(2) << 1.0, 0.0).finished(),
                                sample_times(0.0, 0.1, 40));
  EXPECT_EQ(run.status, IntegrationStatus::StepTooSmall);
  EXPECT_NEAR(run.end_time, std::sqrt(2.0 / 9.81) * 3.0, 1e-4) << "the sum of all flights";
  EXPECT_GE(run.states.col(0).minCoeff(), -1e-6) << "it does not fall through the floor";
}

TEST(Events, JumpOverAGuardSetsItOff) {
  const OdeModel model = parse_ode(
      "dx/dt = 0\ndn/dt = 0\nat 1: x += 3\nwhen x > 2: n += 1, x = 0.5\n", "m.ode");
  const Solution run = simulate(model, Dopri5{}, Vector::Zero(2), sample_times(0.0, 0.5, 5));
  EXPECT_DOUBLE_EQ(run.states(4, 0), 0.5);
  EXPECT_DOUBLE_EQ(run.states(4, 1), 1.0);
}

TEST(Events, GuardThatIsPassedTwiceBetweenSamplesIsSeen) {
  // x = sin t is above 0.99 for 0.28 around each maximum; samples are a period apart.
  const OdeModel model = parse_ode(
      "dx/dt = y\ndy/dt = -x\ndn/dt = 0\nwhen x > 0.99: n += 1\n", "m.ode");
  const Solution run =
      simulate(model, Dopri87{}, (Vector(3) << 0.0, 1.0, 0.0).finished(),
               sample_times(0.0, 6.283185307179586, 6));
  EXPECT_DOUBLE_EQ(run.states(5, 2), 5.0);
}

TEST(Events, TimesBesideASampleAreThere) {
  const OdeModel model = parse_ode("dx/dt = 0\nevery 0.1: x += 1\n", "m.ode");
  const Vector times = sample_times(0.0, 0.1, 4);  // the last is 0.30000000000000004
  const std::vector<Occurrence> found = occurrences_at(model.events(), times);
  ASSERT_EQ(found.size(), 4u);
  for (const Occurrence& one : found)
    EXPECT_TRUE((times.array() == one.time).any()) << one.time;
}

}  // namespace
}  // namespace lacuna
