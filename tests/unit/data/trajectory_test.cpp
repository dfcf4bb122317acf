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

}  // namespace
}  // namespace lacuna
