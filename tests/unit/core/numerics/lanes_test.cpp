// SPDX-License-Identifier: MIT
#include "core/numerics/lanes.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace lacuna {
namespace {

TEST(Lanes, AreReadAndWrittenAnywhereInMemory) {
  std::vector<double> numbers(9);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  for (std::size_t first = 0; first < 5; ++first) {
    const Pack pack = at<kLane>(numbers.data() + first).values;
    EXPECT_EQ(sum(pack), 4.0 * static_cast<double>(first) + 6.0);
  }
  at<kLane>(numbers.data() + 1).values += 10.0;
  EXPECT_EQ(numbers, (std::vector<double>{0, 11, 12, 13, 14, 5, 6, 7, 8}));
}

TEST(Lanes, SumsAreThoseOfAllLanes) {
  std::vector<double> numbers(8);
  std::iota(numbers.begin(), numbers.end(), 1.0);
  EXPECT_EQ(sum(at<2>(numbers.data()).values), 3.0);
  EXPECT_EQ(sum(at<4>(numbers.data()).values), 10.0);
}

TEST(Numbers, AreZeroAtFirst) {
  Numbers<5> some(5);
  Numbers<Eigen::Dynamic> more(7);
  for (Index i = 0; i < 5; ++i) EXPECT_EQ(some[i], 0.0);
  for (Index i = 0; i < 7; ++i) EXPECT_EQ(more[i], 0.0);
  some[3] = 2.0;
  EXPECT_EQ(some.data()[3], 2.0);
}

}  // namespace
}  // namespace lacuna
