// SPDX-License-Identifier: MIT
#include "records/channels/outliers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
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

}  // namespace
}  // namespace lacuna
