// SPDX-License-Identifier: MIT
#include "diagnose/hints/motion_hints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/model/files/ode_text.hpp"
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

/// An armature, L di/dt = u - R i - K w with L/R of 2 ms, and what it turns, under a slow sine.
Dataset armature_record() {
  constexpr double kStep = 0.01;
  constexpr int kParts = 100;
  Dataset data;
  data.states = {{"w", "rad/s"}, {"i", "A"}};
  data.inputs = {{"u", "V"}};
  Trajectory record{"armature",
                    Vector::LinSpaced(1000, 0.0, 999 * kStep),
                    Matrix(1000, 2),
                    Matrix(1000, 1),
                    {}};
  Random random(6);
  double w = 0.0, i = 0.0;
  const auto voltage = [](double t) { return 2.0 * std::sin(0.9 * t); };
  for (Index n = 0; n < 1000; ++n) {
    const double t = record.time[n];
    record.states.row(n) << w + 1e-3 * random.normal(), i + 1e-3 * random.normal();
    record.inputs(n, 0) = voltage(t);
    for (int part = 0; part < kParts; ++part) {
      const double h = kStep / kParts, u = voltage(t + h * part);
      i += h * (500.0 * u - 500.0 * i - 250.0 * w);
      w += h * (4.0 * i - w);
    }
  }
  data.trajectories.push_back(std::move(record));
  return data;
}

TEST(MotionHints, WhatThePlantMakesOfAnInputIsNoFeedback) {
  const BoundRecords open = observed(armature_record());
  const auto kinds = [&](const std::string& current) {
    std::vector<HintKind> found;
    const OdeModel model = parse_ode(
        "input u [V]\nstate w [rad/s]\nstate i [A]\ndw/dt = 4*i - w\ndi/dt = " + current, "m");
    for (const Hint& hint : motion_hints(model, open, rate_windows(open), {}))
      found.push_back(hint.kind);
    return found;
  };
  EXPECT_THAT(kinds("500*u - 500*i - 250*w"),
              ::testing::Not(::testing::Contains(HintKind::ClosedLoop)));
  // Were it not this equation that makes up for u, it would be feedback.
  EXPECT_THAT(kinds("0.01*u - 500*i - 250*w"), ::testing::Contains(HintKind::ClosedLoop));
}

}  // namespace
}  // namespace lacuna
