// SPDX-License-Identifier: MIT
#include "data/logs/range_ends.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "data/formats/read_text.hpp"

namespace lacuna {
namespace {

TEST(RangeEnds, InfinityOfAnOscilloscopeIsTheEndOfTheRange) {
  for (const std::string sign : {"\u221e", "Infinity"}) {
    const Table table = parse_text_table("Time,Channel A,Channel B\n(ms),(V),(mV)\n\n0.0," + sign +
                                             ",1\n0.1,1.5,2\n0.2,-2.5,3\n0.3,-" +
                                             sign + ",4\n",
                                         "pico.csv");
    EXPECT_EQ(table.values.col(1), Eigen::Vector4d(1.5, 1.5, -2.5, -2.5)) << sign;
    EXPECT_EQ(table.values.col(2), Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
    ASSERT_FALSE(table.notes.empty());
    EXPECT_THAT(table.notes.back(),
                ::testing::HasSubstr("'Channel_A' leaves the range of its channel in 2 rows"));
  }
}

TEST(RangeEnds, InfinityOfAProgramStays) {
  const Table table = parse_text_table("t,x\n0,inf\n1,2\n", "a.csv");
  EXPECT_TRUE(std::isinf(table.values(0, 1)));
  EXPECT_TRUE(table.notes.empty());
}

}  // namespace
}  // namespace lacuna
