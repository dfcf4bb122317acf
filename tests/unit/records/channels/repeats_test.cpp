// SPDX-License-Identifier: MIT
#include "records/channels/repeats.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

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
