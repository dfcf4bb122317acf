// SPDX-License-Identifier: MIT
#include "records/channels/outliers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/records/channels/limits.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

/// An oscillation with white noise of deviation 0.01.
Dataset noisy(Index n = 400, double step = 0.01) {
  Dataset data = oscillation_data();
  data.trajectories = {oscillation(n, 0.0, step)};
  Random random(4);
  for (double& value : data.trajectories[0].states.reshaped()) value += 0.01 * random.normal();
  return data;
}

std::vector<Matrix> marks_of(const Dataset& data) {
  return mark_outliers(data, analyse_noise(data));
}

TEST(MarkOutliers, FindsThoseOfEachState) {
  Dataset data = noisy();
  data.trajectories[0].states(100, 0) += 0.3;
  data.trajectories[0].states(200, 0) -= 0.3;
  const Matrix marks = marks_of(data)[0];
  EXPECT_EQ(marks.sum(), 2.0);
  EXPECT_EQ(marks(100, 0), 1.0);
  EXPECT_EQ(marks(200, 0), 1.0);
}

TEST(MarkOutliers, FindsThoseAtTheEnds) {
  for (const Index end : {Index{0}, Index{399}})
    for (const double size : {0.6, -20.0}) {
      Dataset data = noisy();
      data.trajectories[0].states(end, 1) += size;
      const Matrix marks = marks_of(data)[0];
      EXPECT_EQ(marks.sum(), 1.0) << end << ", " << size;
      EXPECT_EQ(marks(end, 1), 1.0);
    }
}

TEST(MarkOutliers, FindsThoseThatAreOffTogether) {
  for (const Index length : {2, 3})
    for (const double size : {0.4, -20.0})
      for (const bool alternates : {false, true}) {
        Dataset data = noisy();
        Matrix& states = data.trajectories[0].states;
        for (Index i = 0; i < length; ++i)
          states(150 + i, 1) += alternates && i % 2 == 1 ? -size : size;
        const Matrix marks = marks_of(data)[0];
        EXPECT_EQ(marks.sum(), static_cast<double>(length)) << size << ", " << alternates;
        EXPECT_EQ(marks.col(1).segment(150, length).sum(), static_cast<double>(length));
      }
}

TEST(MarkOutliers, ShortStretchesThatRecurAreMotion) {
  // Three samples of 200 are off together, then three of 400: more and less than a hundredth.
  for (const Index apart : {200, 400}) {
    Dataset data = noisy(4000);
    double off = 0.0;
    for (Index i = 50; i + 3 < 4000; i += apart, off += 3.0)
      data.trajectories[0].states.col(1).segment(i, 3).array() += 0.4;
    EXPECT_EQ(marks_of(data)[0].sum(), apart == 200 ? 0.0 : off);
  }
}

TEST(MarkOutliers, AKinkIsNone) {
  // Slopes that change between two samples, little and much beside the noise.
  for (const double slope : {0.01, 0.05, 0.2, 1.0})
    for (const double place : {100.5, 200.4, 300.7}) {
      Dataset data = noisy();
      Matrix& states = data.trajectories[0].states;
      for (Index i = 0; i < states.rows(); ++i)
        states(i, 0) += slope * std::abs(static_cast<double>(i) - place);
      EXPECT_EQ(marks_of(data)[0].sum(), 0.0) << slope << ", " << place;
    }
}

TEST(MarkOutliers, TwoAtTheTipOfAKinkAreNotOffTogether) {
  // So sharp that a cubic goes through their neighbours, and not through the two.
  for (const double slope : {0.12, 0.14, 0.16, 0.18})
    for (Index tip = 20; tip < 380; tip += 10) {
      Dataset data = noisy();
      Matrix& states = data.trajectories[0].states;
      for (Index i = 0; i < states.rows(); ++i)
        states(i, 0) += slope * std::abs(static_cast<double>(i - tip) - 0.5);
      EXPECT_LT(marks_of(data)[0].col(0).segment(tip, 2).sum(), 2.0) << slope << ", " << tip;
    }
}

TEST(MarkOutliers, AMotionThatBeginsFastIsNone) {
  // exp(-t / tau) from coarse to fine, with little noise.
  for (const double samples : {2.0, 3.0, 5.0, 10.0, 40.0})
    for (const double noise : {1e-5, 1e-3}) {
      Dataset data = noisy();
      Random random(9);
      Trajectory& record = data.trajectories[0];
      for (Index i = 0; i < record.samples(); ++i)
        record.states.row(i).setConstant(std::exp(-static_cast<double>(i) / samples) +
                                         noise * random.normal());
      EXPECT_EQ(marks_of(data)[0].row(0).sum(), 0.0) << samples << ", " << noise;
    }
}

TEST(MarkOutliers, FindsNoneInCleanRecords) { EXPECT_EQ(marks_of(noisy())[0].sum(), 0.0); }

TEST(MarkOutliers, AStateThatWasMadeHasNone) {
  Dataset data = noisy();
  data.trajectories[0].states(100, 0) += 0.3;
  data.reconstructed = {true, false};
  EXPECT_EQ(marks_of(data)[0].sum(), 0.0);
}

TEST(MarkOutliers, FastStretchesAreNoOutliers) {
  // A pulse of four samples, as a relaxation oscillator sampled coarsely has it.
  Dataset data = noisy(2000);
  std::vector<Index> peaks;
  for (Index i = 100; i + 10 < 2000; i += 100) {
    peaks.push_back(i);
    for (Index j = -2; j <= 2; ++j)
      data.trajectories[0].states(i + j, 0) +=
          2.0 * std::exp(-1.0 * static_cast<double>(j * j));
  }
  const double sigma = analyse_noise(data)[0].sigma;
  const std::vector<Index> suspects = outlying_samples(data.trajectories[0], 0, sigma);
  ASSERT_FALSE(suspects.empty()) << "the peaks look like outliers";
  EXPECT_EQ(marks_of(data)[0].sum(), 0.0) << "and are none, as their neighbours tell";
}

constexpr double kPileUp = 5.0;

/// One state with two thousand samples of a function of time, and white noise on it.
Dataset record_of(double (*signal)(double), double noise) {
  Dataset data;
  data.states = {{"x", "V"}};
  Trajectory record;
  record.time = Vector::LinSpaced(2000, 0.0, 20.0);
  record.states.resize(2000, 1);
  Random random(4);
  for (Index i = 0; i < 2000; ++i)
    record.states(i, 0) = signal(record.time[i]) + noise * random.normal();
  data.trajectories = {std::move(record)};
  return data;
}

double tone(double t) { return std::sin(2.0 * t) + 0.3 * std::sin(5.3 * t); }

Dataset clipped_at(Dataset data, double low, double high) {
  auto x = data.trajectories[0].states.col(0).array();
  x = x.max(low).min(high);
  return data;
}

TEST(VisibleLimits, AreWhereSamplesPileUp) {
  for (const double noise : {0.0, 0.01}) {
    const auto both = visible_limits(clipped_at(record_of(tone, noise), -0.8, 0.7), kPileUp);
    ASSERT_TRUE(both[0].low && both[0].high) << noise;
    EXPECT_EQ(*both[0].low, -0.8);
    EXPECT_EQ(*both[0].high, 0.7);
    const auto one = visible_limits(clipped_at(record_of(tone, noise), -9.0, 0.7), kPileUp);
    EXPECT_TRUE(one[0].high && !one[0].low) << noise;
  }
}

TEST(VisibleLimits, OfWholeSignalsThereAreNone) {
  for (const double noise : {0.0, 0.01}) {
    const auto limits = visible_limits(record_of(tone, noise), kPileUp);
    EXPECT_FALSE(limits[0].low || limits[0].high) << noise;
  }
}

TEST(VisibleLimits, ALatticeIsNoLimit) {
  Dataset data = record_of([](double t) { return std::sin(2.0 * t); }, 0.0);
  auto x = data.trajectories[0].states.col(0).array();
  for (const double bits : {4.0, 6.0, 8.0}) {
    const double step = 2.0 / std::pow(2.0, bits);
    Dataset coarse = data;
    coarse.trajectories[0].states.col(0) = (x / step).round() * step;
    const auto limits = visible_limits(coarse, kPileUp);
    EXPECT_FALSE(limits[0].low || limits[0].high) << bits << " bits";
  }
}

TEST(VisibleLimits, WhatComesToRestIsNotClipped) {
  Dataset data = record_of([](double t) { return 1.0 - std::exp(-3.0 * t); }, 0.0);
  auto x = data.trajectories[0].states.col(0).array();
  x = (1e6 * x).round() / 1e6;  // written with six decimals
  ASSERT_GT((x == 1.0).count(), 1000);
  EXPECT_FALSE(visible_limits(data, kPileUp)[0].high);
}

TEST(VisibleLimits, AStopThatStopsTheStateIsNoEndOfTheChannel) {
  const Dataset data = record_of([](double t) { return std::min(tone(t), 0.7); }, 0.005);
  EXPECT_FALSE(visible_limits(data, kPileUp)[0].high) << "its noise goes on";
}

/// A vessel with one input, a sample each 0.01 s: rests at 0, is filled with 0.3/4 exp(-t/4)
/// per second while u is 1, and is emptied at 0.15 per second while u is -1; below 0 there is
/// nothing.
Dataset vessel(const std::vector<std::pair<double, double>>& phases) {
  Dataset data;
  data.states = {{"h", "m"}};
  data.inputs = {{"u", ""}};
  Trajectory record;
  std::vector<double> level{0.0}, input;
  for (const auto& [u, length] : phases)
    for (double t = 0.0; t < length - 1e-9; t += 0.01) {
      const double h = level.back();
      input.push_back(u);
      level.push_back(u > 0.0 ? 0.3 + (h - 0.3) * std::exp(-0.01 / 4.0)
                              : std::max(0.0, h + 0.0015 * u));
    }
  input.push_back(input.back());
  const auto n = static_cast<Index>(level.size());
  record.time = Vector::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1));
  record.states = Eigen::Map<const Vector>(level.data(), n);
  record.inputs = Eigen::Map<const Vector>(input.data(), n);
  data.trajectories = {std::move(record)};
  return data;
}

TEST(VisibleLimits, TheRestInFrontOfAStepIsNoLimit) {
  const Dataset data = vessel({{0.0, 5.0}, {1.0, 8.0}});
  ASSERT_EQ((data.trajectories[0].states.array() == 0.0).count(), 501);
  EXPECT_FALSE(visible_limits(data, kPileUp)[0].low);
}

TEST(VisibleLimits, TheRestToWhichItComesBackIsNoLimit) {
  // The level stops at 0 at its speed, and stays there while nothing drives it.
  Dataset data = vessel({{0.0, 5.0}, {1.0, 8.0}, {-1.0, 2.0}, {0.0, 5.0}, {1.0, 3.0}});
  Trajectory& record = data.trajectories[0];
  for (Index i = 1; i < record.samples(); ++i)  // the valve closes when the vessel is empty
    if (record.states(i, 0) == 0.0 && record.inputs(i, 0) < 0.0) record.inputs(i, 0) = 0.0;
  EXPECT_FALSE(visible_limits(data, kPileUp)[0].low);
}

TEST(VisibleLimits, WhereTheDriveIsAnotherThanAtRestItIsNoRest) {
  // At rest first, and empty while it is drained later: a channel that shows nothing below 0.
  const Dataset data = vessel({{0.0, 5.0}, {1.0, 8.0}, {-1.0, 6.0}, {1.0, 3.0}});
  EXPECT_EQ(visible_limits(data, kPileUp)[0].low, 0.0);
}

TEST(VisibleLimits, WhatStaysAtItsEndWhileSomethingMovesIsClipped) {
  // The record begins at the end of its channel, and comes back there while its input moves.
  Dataset data =
      clipped_at(record_of([](double t) { return std::cos(2.0 * t); }, 0.0), -0.8, 0.7);
  Trajectory& record = data.trajectories[0];
  data.inputs = {{"u", "V"}};
  record.inputs = (1.3 * record.time.array()).sin().matrix();
  const auto limits = visible_limits(data, kPileUp);
  ASSERT_TRUE(limits[0].low && limits[0].high);
  EXPECT_EQ(*limits[0].high, 0.7);
}

TEST(WithLimits, MarksWhatIsAtAnEndOrBeyond) {
  Dataset data = record_of(tone, 0.01);
  set_mark(data.trajectories[0], 0, 0, Mark::Missing);
  data.trajectories[0].states(0, 0) = 2.0;
  const Dataset marked = with_limits(data, {{-0.8, 0.7}});
  const Trajectory& record = marked.trajectories[0];
  EXPECT_EQ(mark_of(record.marks, 0, 0), Mark::Missing);
  for (Index i = 1; i < 2000; ++i) {
    const double was = data.trajectories[0].states(i, 0);
    const Mark mark = mark_of(record.marks, i, 0);
    EXPECT_EQ(mark, was >= 0.7 ? Mark::AtTop : was <= -0.8 ? Mark::AtBottom : Mark::Value);
    EXPECT_EQ(record.states(i, 0), std::clamp(was, -0.8, 0.7));
  }
}

}  // namespace
}  // namespace lacuna
