// SPDX-License-Identifier: MIT
#include "identify/dead_time/delayed_inputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

/// One record of x and u = i^2 at 0, 0.1, 0.2, ...
Dataset squares(std::optional<Hold> hold) {
  constexpr Index kSamples = 40;
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, 3.9);
  record.states = record.time;
  record.inputs = (10.0 * record.time.array()).round().square().matrix();
  Dataset data;
  data.states = {{"x", ""}};
  data.inputs = {{"u", "", hold}};
  data.trajectories = {record};
  return data;
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
