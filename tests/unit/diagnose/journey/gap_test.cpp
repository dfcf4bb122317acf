// SPDX-License-Identifier: MIT
#include "diagnose/journey/gap.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/diagnose/diagnose.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

TEST(Gap, FallsToTheNoiseWithTheRightEffect) {
  const Dataset data = support::hidden_record(support::dry_friction, 0.01, 3);
  const Dataset other = support::hidden_record(support::dry_friction, 0.01, 4, -0.7);
  const Assimilation base = support::assimilated(data);
  const Explanation found =
      explain({data, base.model, support::oscillator_fit_options(), RunContext{}}, base,
              {{support::plain_candidate("sign(v)"), Vector(0), -0.2}});
  const Gap gap =
      measure_gap(support::oscillator(), found, {as_measured(other), other}, RunContext{});
  EXPECT_GT(gap.before, 2.0 * gap.noise_floor);
  EXPECT_NEAR(gap.after / gap.noise_floor, 1.0, 0.1);
  EXPECT_LT(gap.ratio(), 0.5);
  EXPECT_EQ(gap.records, std::vector<std::string>{"made"});
}

TEST(Gap, StaysWhereNothingIsMissing) {
  const Dataset data = support::hidden_record(support::nothing, 0.01, 3);
  const Explanation nothing{{}, support::assimilated(data)};
  const Dataset other = support::hidden_record(support::nothing, 0.01, 5);
  const Gap gap =
      measure_gap(support::oscillator(), nothing, {as_measured(other), other}, RunContext{});
  EXPECT_NEAR(gap.ratio(), 1.0, 0.05);
}

TEST(Gap, WindowsLastAsLongAsTheirSamplesAtUnevenTimes) {
  const Dataset data = support::hidden_record(support::nothing, 0.01, 3);
  const Explanation nothing{{}, support::assimilated(data)};
  Dataset other = support::hidden_record(support::nothing, 0.01, 5);
  Trajectory& record = other.trajectories[0];
  // Every second sample of the first ones is left out, as where another log begins later.
  std::vector<Index> kept;
  for (Index i = 0; i < record.samples(); ++i)
    if (i > 20 || i % 2 == 0) kept.push_back(i);
  record.time = record.time(kept).eval();
  record.states = record.states(kept, Eigen::all).eval();
  record.inputs = record.inputs(kept, Eigen::all).eval();
  const Gap gap =
      measure_gap(support::oscillator(), nothing, {as_measured(other), other}, RunContext{});
  const GapRecord& run = gap.runs.front();
  const Index begin = run.begin + 2 * run.length;
  EXPECT_NEAR(gap.window, run.time[begin + run.length] - run.time[begin], 1e-6);
}

TEST(Gap, NoiseIsNotWhatAnotherExplanationOfTheSameRecordsExplains) {
  const Dataset data = support::hidden_record(support::dry_friction, 0.01, 3);
  const Explanation nothing{{}, support::assimilated(data)};
  const Dataset other = support::hidden_record(support::dry_friction, 0.01, 4, -0.7);
  const BoundRecords given = as_measured(other);
  const auto gap_above = [&](double known_floor) {
    return measure_gap(support::oscillator(), nothing,
                       {.given = given, .corrected = other, .known_floor = known_floor},
                       RunContext{});
  };
  const Gap own = gap_above(1.0), known = gap_above(1e-3);
  EXPECT_LT(own.noise_floor, 1.0);
  EXPECT_EQ(known.noise_floor, 1e-3);
  EXPECT_EQ(known.after, own.after);
  EXPECT_GT(known.above_floor, own.above_floor);
}

TEST(Gap, CountsWhatTheMeasurementAddsAsPartOfTheModel) {
  const auto skewed = [](std::uint64_t seed, double start) {
    Dataset data = support::hidden_record(support::nothing, 0.001, seed, start);
    Matrix& states = data.trajectories[0].states;
    const Index n = states.rows() - 3;
    states.col(0).head(n) = Vector(states.col(0).tail(n));  // three steps late
    states.conservativeResize(n, Eigen::NoChange);
    data.trajectories[0].time.conservativeResize(n);
    data.trajectories[0].inputs.conservativeResize(n, Eigen::NoChange);
    return data;
  };
  const Dataset data = skewed(3, 1.0);
  Candidate skew = support::plain_candidate("v");
  skew.place = Place::Channel;
  skew.equation = 0;
  const Assimilation base = support::assimilated(data);
  const Explanation found =
      explain({data, base.model, support::oscillator_fit_options(), RunContext{}}, base,
              {{skew, Vector(0), 0.0}});
  const Dataset other = skewed(4, -0.7);
  const Gap gap =
      measure_gap(support::oscillator(), found, {as_measured(other), other}, RunContext{});
  EXPECT_GT(gap.before, 2.0 * gap.noise_floor);
  EXPECT_LT(gap.after, 0.5 * gap.before);
}

TEST(Gap, WhatHasNoFiniteValuesOnTheRecordsIsNotMeasured) {
  const Dataset data = support::hidden_record(support::nothing, 0.01, 3);
  Candidate root = support::plain_candidate("lagged-F");
  root.memory = {{"lagged", parse_expression("(sqrt(F-2)-lagged)/0.5"), parse_expression("F")}};
  const Explanation found{{{root, Vector(0), 1.0}}, support::assimilated(data)};
  const Gap gap =
      measure_gap(support::oscillator(), found, {as_measured(data), data}, RunContext{});
  EXPECT_TRUE(std::isnan(gap.before) && std::isinf(gap.after));
  EXPECT_EQ(gap.records, std::vector<std::string>{"made"});
}

TEST(Gap, AChannelThatNeverMovesIsLeftOut) {
  const Dataset data = support::hidden_record(support::nothing, 0.01, 3);
  const Explanation nothing{{}, support::assimilated(data)};
  Dataset still = support::hidden_record(support::nothing, 0.01, 5);
  still.trajectories[0].states.col(0).setConstant(0.1);
  const Gap gap =
      measure_gap(support::oscillator(), nothing, {as_measured(still), still}, RunContext{});
  EXPECT_TRUE(std::isfinite(gap.before) && std::isfinite(gap.noise_floor)) << gap.before;
}

/// A sensor that is no straight line: what it shows of a position.
double shown(double position) { return 100.0 * position + 20.0 * std::pow(position, 3); }

/// The record with one channel, what a sensor shows of the position, in place of the states.
Dataset encoder_record(std::uint64_t seed, double start) {
  Dataset data = support::hidden_record(support::dry_friction, 0.01, seed, start);
  data.states = {{"enc", ""}};
  data.trajectories[0].states = Matrix(data.trajectories[0].states.col(0).unaryExpr(&shown));
  return data;
}

TEST(Gap, CurvesOfChannelsAreThoseOfTheStatesInTheirFormulas) {
  const std::string position = support::oscillator().states()[0].name;
  const OdeModel nominal = support::oscillator().with_outputs(
      {{"enc", "", parse_expression("100*" + position + "+20*" + position + "^3")}});
  DiagnosisOptions options;
  options.effects = support::own_effects();
  const Diagnosis found = diagnose(nominal, encoder_record(3, 1.0), encoder_record(4, -0.7),
                                   options, RunContext{});
  ASSERT_TRUE(found.gap.has_value());
  ASSERT_FALSE(found.gap->runs.empty());
  const GapRecord& run = found.gap->runs.front();
  ASSERT_EQ(run.before.cols(), 3);
  int compared = 0;
  for (const Matrix* curve : {&run.before, &run.after})
    for (Index i = 0; i < curve->rows(); ++i) {
      if (!std::isfinite((*curve)(i, 0))) continue;
      EXPECT_NEAR((*curve)(i, 2), shown((*curve)(i, 0)), 1e-6) << i;
      ++compared;
    }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace lacuna
