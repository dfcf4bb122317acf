// SPDX-License-Identifier: MIT
#include "core/statistics/robust_statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(RobustStatistics, MedianIsTheMeanOfTheTwoMiddleValues) {
  EXPECT_EQ(median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(median({5.0, 1.0, 3.0, 2.0}), 2.5);
}

TEST(RobustStatistics, UpperMedianIsOneOfTheValues) {
  EXPECT_EQ(upper_median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(upper_median({5.0, 1.0, 3.0, 2.0}), 3.0);
}

TEST(RobustStatistics, QuantilesAreValues) {
  std::vector<double> values{4.0, 0.0, 3.0, 1.0, 2.0};
  EXPECT_EQ(quantile(values, 0.0), 0.0);
  EXPECT_EQ(quantile(values, 0.5), 2.0);
  EXPECT_EQ(quantile(values, 0.8), 3.0);
  EXPECT_EQ(quantile(values, 1.0), 4.0);
}

/// Few sizes are partitioned, many are counted by their leading bits.
TEST(RobustStatistics, MedianSizeIsTheUpperMedianOfFewAndOfMany) {
  for (const std::size_t count : {7U, 4095U, 4096U, 20001U}) {
    Random random(count);
    std::vector<double> sizes(count);
    for (double& size : sizes) size = std::abs(random.normal()) * std::exp(random.normal());
    std::vector<double> sorted = sizes;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(median_size(sizes), sorted[count / 2]) << count;
  }
}

TEST(RobustStatistics, MagnitudesHaveNoSign) {
  EXPECT_EQ(magnitudes(Vector{{-2.0, 0.0, 3.0}}), (std::vector<double>{2.0, 0.0, 3.0}));
}

TEST(RobustStatistics, NormalDeviationIgnoresFewThatAreFarOff) {
  Random random(3);
  std::vector<double> sizes(20000);
  for (double& size : sizes) size = 2.0 * std::abs(random.normal());
  std::fill_n(sizes.begin(), 200, 1e6);
  EXPECT_NEAR(normal_deviation(sizes), 2.0, 0.06);
}

}  // namespace
}  // namespace lacuna
