// SPDX-License-Identifier: MIT
#include "diagnose/hints/motion_hints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

std::vector<HintKind> kinds_of(const Dataset& data) {
  const BoundRecords records = observed(data);
  std::vector<HintKind> kinds;
  for (const Hint& hint :
       motion_hints(support::oscillator(), records, rate_windows(records), {})) {
    kinds.push_back(hint.kind);
    EXPECT_EQ(hint.withheld, Withheld::Nothing);
  }
  return kinds;
}

Dataset good() { return support::hidden_record(support::nothing, 0.01); }

TEST(MotionHints, SayNothingOfAGoodRecord) { EXPECT_TRUE(kinds_of(good()).empty()); }

TEST(MotionHints, TellAnInputThatFollowsTheStates) {
  Dataset data = good();
  Trajectory& record = data.trajectories[0];
  record.inputs =
      -0.5 * record.states.col(0) - 0.3 * record.states.col(1) + 0.1 * record.inputs;
  EXPECT_THAT(kinds_of(data), ::testing::ElementsAre(HintKind::ClosedLoop));
  record.inputs = -0.5 * record.states.col(0) - 0.3 * record.states.col(1);
  EXPECT_THAT(kinds_of(data),
              ::testing::ElementsAre(HintKind::ClosedLoop, HintKind::NotIdentifiable));
}

TEST(MotionHints, StatesThatFollowAnInputAreNoFeedback) {
  Dataset data = good();
  Trajectory& record = data.trajectories[0];
  Random random(5);
  double level = 0.0;
  for (Index i = 0; i < record.samples(); ++i) {
    record.states(i, 0) = 0.5 * level + 0.01 * random.normal();  // of the step before
    record.states(i, 1) = -level + 0.01 * random.normal();
    if (i % 40 == 0) level = random.normal();
    record.inputs(i, 0) = level;
  }
  EXPECT_THAT(kinds_of(data), ::testing::Not(::testing::Contains(HintKind::ClosedLoop)));
  for (Index i = 1; i < record.samples(); ++i)
    record.inputs(i, 0) = -record.states(i, 1) + 0.01 * random.normal();
  EXPECT_THAT(kinds_of(data), ::testing::Contains(HintKind::ClosedLoop));
}

TEST(MotionHints, TellWhatDoesNotMove) {
  Dataset data = good();
  data.trajectories[0].inputs.setConstant(0.7);
  EXPECT_THAT(kinds_of(data), ::testing::ElementsAre(HintKind::Excitation));
  data = good();
  Random random(4);
  for (double& q : data.trajectories[0].states.col(0)) q = 1e-3 * random.normal();
  EXPECT_THAT(kinds_of(data), ::testing::Contains(HintKind::Excitation));
}

std::vector<Hint> hints_of(const Dataset& data) {
  const BoundRecords records = observed(data);
  return motion_hints(support::oscillator(), records, rate_windows(records), {});
}

TEST(MotionHints, WhiteNoiseTellsNothing) {
  Random random(8);
  Dataset still = good();
  Trajectory& record = still.trajectories[0];
  for (double& value : record.states.reshaped()) value = 1.0 + 0.01 * random.normal();
  const std::vector<Hint> hints = hints_of(still);
  EXPECT_EQ(withheld_by(hints), Withheld::Claims);
  EXPECT_THAT(hints.back().message, HasSubstr("nothing moves"));
  // A channel that never changes says no more.
  still.trajectories[0].states.col(1).setConstant(3.0);
  EXPECT_EQ(withheld_by(hints_of(still)), Withheld::Claims);
  // A motion of half the noise in one state is something.
  for (Index i = 0; i < record.samples(); ++i)
    record.states(i, 0) += 0.007 * std::sin(2.0 * record.time[i]);
  EXPECT_EQ(withheld_by(hints_of(still)), Withheld::Nothing);
}

TEST(MotionHints, TellFewSamplesAndFewPeriods) {
  const Dataset data = good();
  const Trajectory& record = data.trajectories[0];
  Dataset coarse = data;
  const auto every = Eigen::seqN(0, 50, 30);  // 0.6 s of periods of 3 s
  coarse.trajectories = {{"r", record.time(every), record.states(every, Eigen::all),
                          record.inputs(every, Eigen::all), Matrix()}};
  EXPECT_THAT(kinds_of(coarse), ::testing::Contains(HintKind::Sampling));
  Dataset brief = data;
  brief.trajectories = {rows_of(record, 0, 200)};
  EXPECT_THAT(kinds_of(brief), ::testing::Contains(HintKind::Sampling));
}

TEST(MotionHints, OneWayToARestTellsNoStructure) {
  Dataset data = good();
  data.trajectories = {rows_of(data.trajectories[0], 0, 200)};
  EXPECT_EQ(withheld_by(hints_of(data)), Withheld::Nothing) << "the input moves";
  data.trajectories[0].inputs.setConstant(0.7);
  const std::vector<Hint> hints = hints_of(data);
  EXPECT_EQ(withheld_by(hints), Withheld::Names);
  data = good();
  data.trajectories[0].inputs.setConstant(0.7);
  EXPECT_EQ(withheld_by(hints_of(data)), Withheld::Nothing) << "many periods";
}

TEST(StepsInPeriod, AreThoseOfASineWithNoise) {
  Dataset data = support::oscillator_record();  // q = sin 2t in steps of 0.01
  EXPECT_NEAR(steps_in_period(data, 0, 0.0), 100.0 * std::numbers::pi, 8.0);
  Random random(2);
  for (double& q : data.trajectories[0].states.col(0)) q += 0.02 * random.normal();
  EXPECT_NEAR(steps_in_period(data, 0, 0.02), 100.0 * std::numbers::pi, 60.0);
}

}  // namespace
}  // namespace lacuna
