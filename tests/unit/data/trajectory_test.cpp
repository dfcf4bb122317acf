// SPDX-License-Identifier: MIT
#include "lacuna/data/trajectory.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lacuna {
namespace {

Trajectory at_times(const std::vector<double>& times) {
  Trajectory trajectory;
  trajectory.time = Eigen::Map<const Vector>(times.data(), static_cast<Index>(times.size()));
  return trajectory;
}

TEST(UniformStep, IsTheMeanStep) {
  EXPECT_DOUBLE_EQ(*uniform_step(at_times({1.0, 1.5, 2.0, 2.5})), 0.5);
  EXPECT_DOUBLE_EQ(*uniform_step(at_times({0.0, 1.0005, 2.0})), 1.0);
}

TEST(UniformStep, IsNothingWhenStepsDiffer) {
  EXPECT_FALSE(uniform_step(at_times({0.0, 1.0, 2.1})));
  EXPECT_TRUE(uniform_step(at_times({0.0, 1.0, 2.1}), 0.1));
}

TEST(UniformStep, IsNothingForFewerThanTwoSamples) {
  EXPECT_FALSE(uniform_step(at_times({})));
  EXPECT_FALSE(uniform_step(at_times({1.0})));
}

TEST(Steps, MeanAndMedian) {
  const Trajectory record = at_times({0.0, 1.0, 2.0, 6.0});
  EXPECT_DOUBLE_EQ(record.duration(), 6.0);
  EXPECT_DOUBLE_EQ(mean_step(record), 2.0);
  EXPECT_DOUBLE_EQ(median_step(record), 1.0);
}

TEST(GoesOn, AfterAShortGapInTheSameFile) {
  Trajectory before = at_times({0.0, 1.0}), after = at_times({3.0, 4.0});
  before.source = "run.csv, record 1";
  after.source = "run.csv, record 2";
  EXPECT_EQ(file_of(after), "run.csv");
  EXPECT_TRUE(goes_on(before, after, 2.0));
  EXPECT_FALSE(goes_on(before, after, 1.9));
  EXPECT_FALSE(goes_on(after, before, 9.0));
  after.source = "other.csv, record 2";
  EXPECT_FALSE(goes_on(before, after, 2.0));
}

}  // namespace
}  // namespace lacuna
