// SPDX-License-Identifier: MIT
#include "records/channels/outliers.hpp"

#include <gtest/gtest.h>

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
