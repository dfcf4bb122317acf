// SPDX-License-Identifier: MIT
#include "identify/dead_time/dead_time_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "identify/dead_time/delayed_inputs.hpp"
#include "identify/dead_time/screened_dead_times.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

constexpr const char* kPendulum =
    "input u\ndx/dt = v\ndv/dt = -12*sin(x) - 0.1*v - 0.3*tanh(v/0.01) + u\n";

/// What kPendulum does under two slow tones, behind noise of 3e-3 and 1e-2.
Dataset swings() {
  constexpr Index kSamples = 3000, kFine = 20;
  constexpr double kStep = 0.01;
  const auto torque = [](double t) { return 4.0 * std::sin(1.1 * t) + 3.0 * std::sin(0.43 * t); };
  Random random(21);
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, kStep * (kSamples - 1.0));
  record.states.resize(kSamples, 2);
  record.inputs.resize(kSamples, 1);
  double x = 1.4, v = 0.0;
  const double h = kStep / kFine;
  const auto pull = [](double angle, double speed, double drive) {
    return -12.0 * std::sin(angle) - 0.1 * speed - 0.3 * std::tanh(speed / 0.01) + drive;
  };
  for (Index i = 0; i < kSamples; ++i) {
    record.states.row(i) << x + 3e-3 * random.normal(), v + 1e-2 * random.normal();
    record.inputs(i, 0) = torque(record.time[i]);
    for (Index s = 0; s < kFine; ++s) {  // the midpoint rule
      const double t = record.time[i] + h * static_cast<double>(s);
      const double half = v + 0.5 * h * pull(x, v, torque(t));
      const double middle = x + 0.5 * h * v;
      v += h * pull(middle, half, torque(t + 0.5 * h));
      x += h * half;
    }
  }
  Dataset data;
  data.states = {{"x", ""}, {"v", ""}};
  data.inputs = {{"u", ""}};
  data.trajectories = {record};
  data.rate_of = {std::nullopt, std::nullopt};
  return data;
}

/// Cubes of the angle are no sine: of that the rows of a library make a dead time. Equations
/// whose free run leaves the noise alone have no use for it.
TEST(DeadTimeSearch, EquationsThatRunToTheNoiseAreNotSoughtAgain) {
  const Dataset data = swings();
  const Pipeline pipeline = IdentificationTask{}.pipeline;
  ASSERT_GT(screened_dead_times(data, pipeline, {}, GivenTimes(1), {})[0], 0.0);
  const auto searches_from = [&](const char* model) {
    const IdentificationResult once{parse_ode(model, "made"), {}, {}, {}, {}, {}};
    int count = 0;
    const FindEquations find = [&](const Dataset&) {
      ++count;
      return once;
    };
    equations_with_dead_times(data, pipeline, {}, once, find, {analyse_noise(data), 0.1}, {});
    return count;
  };
  EXPECT_EQ(searches_from(kPendulum), 0);
  EXPECT_EQ(searches_from("input u\ndx/dt = v\ndv/dt = -10*x - 0.1*v + u\n"), 1);
}

/// One record of x and u = i^2 at 0, 0.1, 0.2, ...
Dataset squares(std::optional<Hold> hold) {
  constexpr Index kSamples = 40;
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, 3.9);
  record.states = record.time;
  record.inputs = (10.0 * record.time.array()).round().square().matrix();
  return support::one_record({{"x", ""}}, {{"u", "", hold}}, record);
}

Vector one(double time) { return Vector::Constant(1, time); }

TEST(DelayedInputs, OfWholeStepsAreEarlierSamplesToTheBit) {
  const Dataset delayed = with_inputs_delayed(squares(Hold::Zero), one(0.3), 0.5);
  const Trajectory& record = delayed.trajectories.at(0);
  ASSERT_EQ(record.samples(), 35);
  EXPECT_DOUBLE_EQ(record.time[0], 0.5);
  EXPECT_DOUBLE_EQ(record.states(0, 0), 0.5);
  for (Index i = 0; i < 35; ++i)
    EXPECT_EQ(record.inputs(i, 0), std::pow(static_cast<double>(i + 2), 2));
}

TEST(DelayedInputs, ThatAreHeldAreMeansOfWhatActsDuringAStep) {
  const Dataset delayed = with_inputs_delayed(squares(Hold::Zero), one(0.125), 0.5);
  const Trajectory& record = delayed.trajectories.at(0);
  // A quarter of the step after 0.5 s the sample of 0.4 s takes over from that of 0.3 s.
  EXPECT_NEAR(record.inputs(0, 0), 0.25 * 9.0 + 0.75 * 16.0, 1e-9);
}

TEST(DelayedInputs, ThatAreSmoothLieOnTheirCurve) {
  const Dataset delayed = with_inputs_delayed(squares({}), one(0.17), 0.5);
  const Trajectory& record = delayed.trajectories.at(0);
  for (Index i = 3; i < 30; ++i)
    EXPECT_NEAR(record.inputs(i, 0), std::pow(10.0 * (record.time[i] - 0.17), 2), 1e-9);
}

TEST(DelayedInputs, RecordsOfWhichLittleRemainsAreLeftOut) {
  EXPECT_TRUE(with_inputs_delayed(squares(Hold::Zero), one(0.3), 2.5).trajectories.empty());
}

TEST(DelayedInputs, AreWrittenAsDelays) {
  IdentificationResult result{
      parse_ode("input u\ninput v\ndx/dt = 2*u^2 - x*u + 3*v\n", "made"), {}, {}, {}, {}, {}};
  result.trail = {{.equation = "x", .term = "x*u"}};
  const IdentificationResult late =
      with_delays_written(std::move(result), (Vector(2) << 0.25, 0.0).finished());
  std::vector<std::string> terms;
  for (const WeightedTerm& summand : late.model.equations()[0])
    terms.push_back(summand.term.name());
  EXPECT_THAT(terms, ::testing::ElementsAre("delay(u,0.25)^2", "x*delay(u,0.25)", "v"));
  EXPECT_EQ(late.trail[0].term, "x*delay(u,0.25)");
}

}  // namespace
}  // namespace lacuna
