// SPDX-License-Identifier: MIT
#include "data/logs/log_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using Use = LogColumn::Use;

std::vector<Use> uses_of(const std::optional<LogLayout>& layout) {
  std::vector<Use> uses;
  for (const LogColumn& column : layout->columns) uses.push_back(column.use);
  return uses;
}

TEST(LogLayout, APlainTableHasNone) {
  EXPECT_FALSE(find_log_layout("t,x\n0,1\n1,2\n"));
  EXPECT_FALSE(find_log_layout("t [s] x [V]\n0 1\n1 2\n"));
  EXPECT_FALSE(find_log_layout(""));
  EXPECT_FALSE(find_log_layout("Dear all,\nwe have 3 pumps, and\n"));
  EXPECT_FALSE(find_log_layout("name,value\nfoo,1\nbar,2\n")) << "there is no time beside it";
}

TEST(LogLayout, ColumnsOfEachKind) {
  const auto layout = find_log_layout(
      "id,when,mode,u,x,empty\n1,2023-01-01 10:00:00,on,1.5 V,2,\n"
      "2,2023-01-01 10:00:01,off,1.6 V,3,\n3,2023-01-01 10:00:02,on,1.7 V,5,\n");
  ASSERT_TRUE(layout);
  EXPECT_THAT(uses_of(layout), ElementsAre(Use::Number, Use::Time, Use::Text, Use::Quantity,
                                           Use::Number, Use::Blank));
  EXPECT_EQ(layout->before, 1u);
  EXPECT_EQ(layout->time, 1u);
  EXPECT_EQ(layout->columns[3].unit, "V");
  EXPECT_EQ(layout->columns[2].name, "mode");
}

TEST(LogLayout, ACountWithoutANameIsNoState) {
  const auto layout = find_log_layout(",when,x\n0,10:00:00,4\n1,10:00:01,5\n2,10:00:02,7\n");
  ASSERT_TRUE(layout);
  EXPECT_THAT(uses_of(layout), ElementsAre(Use::Count, Use::Time, Use::Number));
  const auto other = find_log_layout(",when,x\n0,10:00:00,4\n1,10:00:01,5\n4,10:00:02,7\n");
  ASSERT_TRUE(other);
  EXPECT_THAT(uses_of(other), ElementsAre(Use::Number, Use::Time, Use::Number));
}

TEST(LogLayout, DateTimeAndZoneInThreeColumns) {
  const auto layout = find_log_layout(
      "1;25.10.2026;02:59:59;+0200;1,5\n2;25.10.2026;02:00:00;+0100;2,5\n");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->delimiter, ';');
  EXPECT_EQ(layout->time, 1u);
  EXPECT_EQ(layout->time_parts, 3u);
}

TEST(LogLayout, TimesWithTheNameOfOthersAreClocksOfTheirChannels) {
  const auto layout = find_log_layout("Time;x;Time;y\n0;1;0;2\n1;2;1;4\n2;4;2;5\n");
  ASSERT_TRUE(layout);
  EXPECT_THAT(uses_of(layout),
              ElementsAre(Use::Number, Use::Number, Use::Clock, Use::Number));
  EXPECT_EQ(layout->columns[2].name, "Time_3");
}

TEST(LogLayout, WordsAmongNumbersAreNoColumnOfText) {
  EXPECT_FALSE(find_log_layout("t,x,y\n0,1,2\n1,abc,3\n2,3,4\n3,5,6\n"))
      << "the reader says where they are";
}

TEST(LogLayout, AMonitorsArrowIsADelimiter) {
  EXPECT_THAT(cells_of("23:59:52.512 -> 1.2,3", ','), ElementsAre("23:59:52.512", "1.2", "3"));
  EXPECT_THAT(cells_of("a -> b,3", ','), ElementsAre("a -> b", "3"));
}

}  // namespace
}  // namespace lacuna
