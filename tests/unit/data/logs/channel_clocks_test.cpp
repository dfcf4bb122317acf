// SPDX-License-Identifier: MIT
#include "data/logs/channel_clocks.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

constexpr double kBlank = std::numeric_limits<double>::quiet_NaN();

/// Times of x, x, times of y, y.
Table two_channels(const Matrix& values) {
  Table table;
  table.source = "scope.csv";
  table.columns = {{"t", "s"}, {"x", "V"}, {"t_3", "s"}, {"y", "A"}};
  table.headers = {"t", "x", "t_3", "y"};
  table.values = values;
  for (Index row = 0; row < values.rows(); ++row)
    table.lines.push_back(static_cast<std::size_t>(row) + 2);
  return table;
}

TEST(ChannelClocks, OneClockIsFoundAndItsRowsStay) {
  const Table table =
      two_channels(Matrix{{0.0, 1.0, 0.0, 5.0}, {1.0, 2.0, 1.0, 6.0}, {2.0, 3.0, kBlank, kBlank}});
  EXPECT_TRUE(are_one_clock(table, {0, 2}));
  const Table joined = with_one_clock(table, {0, 2});
  ASSERT_EQ(joined.columns.size(), 3u);
  EXPECT_EQ(joined.columns[2].unit, "A");
  EXPECT_EQ(joined.headers.back(), "y");
  EXPECT_EQ(joined.values(1, 2), 6.0);
  EXPECT_TRUE(std::isnan(joined.values(2, 2)));
}

TEST(ChannelClocks, EachTimeOfAnyChannelHasARow) {
  const Table table = two_channels(Matrix{{0.0, 1.0, 0.5, 5.0}, {1.0, 2.0, 1.0, 6.0}});
  EXPECT_FALSE(are_one_clock(table, {0, 2}));
  const Table joined = with_one_clock(table, {0, 2});
  EXPECT_EQ(joined.values.col(0), Eigen::Vector3d(0.0, 0.5, 1.0));
  EXPECT_TRUE(std::isnan(joined.values(0, 2)));
  EXPECT_TRUE(std::isnan(joined.values(1, 1)));
  EXPECT_EQ(joined.values.row(2), Eigen::RowVector3d(1.0, 2.0, 6.0));
  EXPECT_EQ(joined.lines, (std::vector<std::size_t>{2, 2, 3}));
}

TEST(ChannelClocks, AClockThatGoesBackwardsIsAnError) {
  testing::expect_error<DataError>(
      [] {
        with_one_clock(two_channels(Matrix{{0.0, 1.0, 0.5, 5.0}, {1.0, 2.0, 0.4, 6.0}}), {0, 2});
      },
      "scope.csv:3:3", "goes backwards", "sort its rows");
}

}  // namespace
}  // namespace lacuna
