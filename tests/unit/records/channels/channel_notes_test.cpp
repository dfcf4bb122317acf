// SPDX-License-Identifier: MIT
#include "records/channels/channel_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/data/records/marks.hpp"
#include "records/channels/repeats.hpp"
#include "records/channels/shown_holds.hpp"
#include "support/driven_oscillator.hpp"
#include "support/held_oscillator.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// One channel of span 2 V, as it is described.
std::vector<std::string> notes_of(const Channel& channel) {
  BoundRecords records;
  records.data.states = {{"q", "V"}};
  Trajectory record;
  record.time = Vector{{0.0, 1.0, 2.0}};
  record.states = Matrix{{-1.0}, {0.0}, {1.0}};
  records.data.trajectories = {std::move(record)};
  records.channels = {channel};
  return channel_notes(records);
}

TEST(ChannelNotes, SayWhereAChannelIsClipped) {
  const Channel both{.at_top = 0.12, .at_bottom = 0.034, .limits = {-1.0, 1.0}};
  EXPECT_THAT(notes_of(both), ElementsAre(HasSubstr(
                                  "clipped-channel: q is clipped at 1 V: 12 % of the samples, "
                                  "at -1 V: 3.4 % of the samples")));
  EXPECT_THAT(notes_of({.at_top = 0.12, .limits = {{}, 1.0}}),
              ElementsAre(::testing::Not(HasSubstr("-1 V"))));
}

TEST(ChannelNotes, SayHowManySamplesAreMissing) {
  EXPECT_THAT(notes_of({.missing = 0.8}), ElementsAre(HasSubstr("dropouts: 80 %")));
  EXPECT_THAT(notes_of({.measured = false, .missing = 0.8}), IsEmpty());
}

/// One channel at steps of 0.1, with rows at steps of 0.037 between in which it has no sample, as
/// those of another log, and without every so many of its own.
std::vector<std::string> notes_of_joined(Index lost_each) {
  BoundRecords records;
  records.data.states = {{"q", "V"}};
  std::vector<double> own, times;
  for (Index i = 0; i < 200; ++i) own.push_back(0.1 * static_cast<double>(i));
  times = own;
  for (Index i = 1; i < 500; ++i) times.push_back(0.037 * static_cast<double>(i) + 1e-3);
  std::sort(times.begin(), times.end());
  Trajectory record;
  const auto n = static_cast<Index>(times.size());
  record.time = Eigen::Map<const Vector>(times.data(), n);
  record.states = record.time.array().sin();
  Index missing = 0;
  for (Index i = 0; i < n; ++i) {
    const auto at = std::find(own.begin(), own.end(), record.time[i]);
    const bool is_lost =
        at != own.end() && lost_each > 0 && (at - own.begin()) % lost_each == lost_each - 2;
    if (at != own.end() && !is_lost) continue;
    set_mark(record, i, 0, Mark::Missing);
    ++missing;
  }
  records.data.trajectories = {std::move(record)};
  records.channels = {
      {.missing = static_cast<double>(missing) / static_cast<double>(n)}};
  return channel_notes(records);
}

TEST(ChannelNotes, RowsOfAnotherLogAreNoDropouts) {
  EXPECT_THAT(notes_of_joined(0),
              ElementsAre(HasSubstr("q has samples of its own in 29 % of the rows")));
  EXPECT_THAT(notes_of_joined(20), ElementsAre(HasSubstr("dropouts: 5 % of the samples of q")));
}

TEST(ChannelNotes, SayHowCoarseAChannelIsWhereThatMatters) {
  Channel coarse{.noise = {0.0045, NoiseKind::Quantised, 2.0 / 128.0}};
  EXPECT_THAT(notes_of(coarse), ElementsAre(HasSubstr("resolution of 8 bits")));
  coarse.noise = {0.01, NoiseKind::White, 2.0 / 128.0};
  EXPECT_THAT(notes_of(coarse), ElementsAre(HasSubstr("a part of its noise")));
  coarse.noise = {0.1, NoiseKind::White, 2.0 / 128.0};
  EXPECT_THAT(notes_of(coarse), IsEmpty()) << "hidden in other noise";
  coarse.noise = {3e-7, NoiseKind::Quantised, 1e-6};
  EXPECT_THAT(notes_of(coarse), IsEmpty()) << "digits of the file";
}

TEST(ShownHolds, StepsShowThemselvesAndSmoothSignalsDoNot) {
  EXPECT_EQ(shown_hold(support::held_record(Hold::Zero, 0.0), 0), Hold::Zero);
  EXPECT_EQ(shown_hold(support::hidden_record(support::nothing, 0.0), 0), Hold::Smooth);
}

TEST(ShownHolds, EveryRecordInWhichItMovesHasToShowIt) {
  Dataset data = support::held_record(Hold::Zero, 0.0);
  Trajectory still = data.trajectories.front();
  still.inputs.setConstant(2.0);
  data.trajectories.push_back(still);
  EXPECT_EQ(shown_hold(data, 0), Hold::Zero);
  data.trajectories.push_back(
      support::hidden_record(support::nothing, 0.0).trajectories.front());
  EXPECT_EQ(shown_hold(data, 0), Hold::Smooth);
  data.trajectories = {still};
  EXPECT_EQ(shown_hold(data, 0), std::nullopt);
}

TEST(ShownHolds, TheModelComesFirst) {
  const OdeModel model = support::oscillator();
  const Dataset data = support::held_record(Hold::Zero, 0.0);
  EXPECT_EQ(with_shown_holds(model, data).inputs()[0].hold, Hold::Zero);
  EXPECT_EQ(with_shown_holds(model.with_holds({Hold::Linear}), data).inputs()[0].hold,
            Hold::Linear);
}

TEST(ShownHolds, RecordsGetThoseThatNothingIsSaidOf) {
  Dataset data = support::held_record(Hold::Zero, 0.0);
  data.inputs[0].hold.reset();
  const auto held = with_shown_holds(data);
  ASSERT_TRUE(held);
  EXPECT_EQ(held->inputs[0].hold, Hold::Zero);
  data.inputs[0].hold = Hold::Linear;
  EXPECT_FALSE(with_shown_holds(data));
  EXPECT_FALSE(with_shown_holds(support::hidden_record(support::nothing, 0.0)));
}

Dataset noisy_tone(double noise) {
  Dataset data;
  data.states = {{"x", "V"}};
  Trajectory record;
  record.time = Vector::LinSpaced(2000, 0.0, 20.0);
  record.states.resize(2000, 1);
  Random random(4);
  for (Index i = 0; i < 2000; ++i)
    record.states(i, 0) = std::sin(2.0 * record.time[i]) + noise * random.normal();
  data.trajectories = {std::move(record)};
  return data;
}

/// Marks by the number of samples that have them.
Index missing_in(const Dataset& data) {
  Index count = 0;
  for (Index i = 0; i < data.samples(); ++i)
    count += mark_of(data.trajectories[0].marks, i, 0) == Mark::Missing ? 1 : 0;
  return count;
}

TEST(WithRepeatsMarked, FindsTheLastValueShownAgain) {
  Dataset data = noisy_tone(0.01);
  auto x = data.trajectories[0].states.col(0);
  for (const Index begin : {100, 400, 777, 1500})
    for (Index i = 1; i <= 10; ++i) x[begin + i] = x[begin];
  const Dataset marked = with_repeats_marked(data);
  EXPECT_EQ(missing_in(marked), 40);
  EXPECT_EQ(mark_of(marked.trajectories[0].marks, 100, 0), Mark::Value) << "the value itself";
  EXPECT_EQ(mark_of(marked.trajectories[0].marks, 110, 0), Mark::Missing);
}

TEST(WithRepeatsMarked, FindsAChannelThatIsSlower) {
  for (const double noise : {0.0, 0.01}) {
    Dataset data = noisy_tone(noise);
    auto x = data.trajectories[0].states.col(0);
    for (Index i = 0; i < x.size(); ++i) x[i] = x[i - i % 5];
    EXPECT_EQ(missing_in(with_repeats_marked(data)), 1600) << noise;
  }
}

TEST(WithRepeatsMarked, ValuesOnALatticeRepeatByThemselves) {
  for (const double noise : {0.0, 0.01, 0.05}) {
    Dataset data = noisy_tone(noise);
    auto x = data.trajectories[0].states.col(0).array();
    x = (x / 0.02).round() * 0.02;
    EXPECT_EQ(missing_in(with_repeats_marked(data)), 0) << noise;
  }
}

// A converter behind a curve: levels exp(k/30), printed to two digits behind the point.
TEST(WithRepeatsMarked, SoDoValuesOnOneOfUnevenSteps) {
  for (const double noise : {0.0, 0.01}) {
    Dataset data = noisy_tone(noise);
    auto x = data.trajectories[0].states.col(0).array();
    x = ((30.0 * (3.0 + x)).round() / 30.0).exp();
    x = (100.0 * x).round() / 100.0;
    EXPECT_EQ(missing_in(with_repeats_marked(data)), 0) << noise;
  }
}

TEST(WithRepeatsMarked, WhatRestsWithoutNoiseIsMeasured) {
  Dataset data = noisy_tone(0.0);
  auto x = data.trajectories[0].states.col(0);
  x.segment(500, 200).setConstant(x[500]);
  EXPECT_EQ(missing_in(with_repeats_marked(data)), 0);
}

}  // namespace
}  // namespace lacuna
