// SPDX-License-Identifier: MIT
#include "records/channels/interpolated.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

const Vector kTime = Vector::LinSpaced(2001, 0.0, 20.0);

/// sin(2 t) with noise.
Vector noisy_sine(double noise) {
  Random random(4);
  Vector values(kTime.size());
  for (Index i = 0; i < values.size(); ++i)
    values[i] = std::sin(2.0 * kTime[i]) + noise * random.normal();
  return values;
}

/// Every `each`-th sample of a signal from `first` on, and lines between.
Vector on_lines(const Vector& values, Index each, double first = 0.0) {
  Vector result(values.size());
  for (Index i = 0; i < result.size(); ++i) {
    const double place = (static_cast<double>(i) - first) / static_cast<double>(each);
    const double before = first + std::floor(place) * static_cast<double>(each);
    const auto at = [&](double sample) {
      return values[std::clamp<Index>(std::lround(sample), 0, values.size() - 1)];
    };
    const double fraction = place - std::floor(place);
    result[i] =
        (1.0 - fraction) * at(before) + fraction * at(before + static_cast<double>(each));
  }
  return result;
}

TEST(InterpolatedSamples, AreThoseBetweenTheOnesOfASlowerChannel) {
  for (const double noise : {0.0, 0.01}) {
    const auto found = interpolated_samples(kTime, on_lines(noisy_sine(noise), 5), 1e-9);
    ASSERT_EQ(found.size(), 1600u) << noise;
    EXPECT_EQ(found[0], 1);
    EXPECT_EQ(found[4], 6) << "the fifth was measured";
  }
}

TEST(InterpolatedSamples, AreFoundWhereTheSlowerChannelHasOtherTimes) {
  const auto found = interpolated_samples(kTime, on_lines(noisy_sine(0.01), 5, 2.5), 1e-9);
  // Of each five the two beside the bend are kept: one value each that was not measured.
  EXPECT_NEAR(static_cast<double>(found.size()), 1200.0, 3.0);
}

TEST(InterpolatedSamples, AreNoneOfASignalThatWasSampled) {
  for (const double noise : {0.0, 1e-9, 1e-6, 0.01}) {
    EXPECT_TRUE(interpolated_samples(kTime, noisy_sine(noise), 1e-6).empty()) << noise;
    EXPECT_TRUE(interpolated_samples(kTime, noisy_sine(noise), 1e-4).empty()) << noise;
  }
}

TEST(InterpolatedSamples, AreNoneOfStretchesThatAreNearlyStraightWhereverTheyBegin) {
  const Vector fast = (7.0 * kTime.array()).sin();
  EXPECT_TRUE(interpolated_samples(kTime, fast, 2e-3).empty());
}

TEST(InterpolatedSamples, AreNoneOfRoundedOrHeldValuesLinesAndRest) {
  const Vector rounded = (noisy_sine(0.0).array() / 0.02).round() * 0.02;
  EXPECT_TRUE(interpolated_samples(kTime, rounded, 0.0).empty());
  EXPECT_TRUE(interpolated_samples(kTime, kTime, 1e-9).empty());
  Vector held = noisy_sine(0.01);
  for (Index i = 0; i < held.size(); ++i) held[i] = held[i - i % 5];
  EXPECT_TRUE(interpolated_samples(kTime, held, 1e-9).empty());
  Vector resting = noisy_sine(0.0);
  resting.segment(500, 200).setConstant(resting[500]);
  EXPECT_TRUE(interpolated_samples(kTime, resting, 1e-9).empty());
}

TEST(InterpolatedSamples, OfStatesSayNothing) {
  Dataset data;
  data.states = {{"x", "V"}, {"y", "V"}};
  Trajectory record;
  record.time = kTime;
  record.states.resize(kTime.size(), 2);
  record.states.col(0) = noisy_sine(0.01);
  record.states.col(1) = on_lines(noisy_sine(0.01), 4);
  data.trajectories = {std::move(record)};
  const Matrix marks = marks_of(with_interpolated_marked(data).trajectories[0]);
  EXPECT_EQ((marks.col(0).array() != 0.0).count(), 0);
  EXPECT_EQ((marks.col(1).array() == number_of(Mark::Missing)).count(), 1500);
}

}  // namespace
}  // namespace lacuna
