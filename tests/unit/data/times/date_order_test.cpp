// SPDX-License-Identifier: MIT
#include "data/times/date_order.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(DateOrder, ANumberAboveTwelveIsADay) {
  EXPECT_EQ(order_of_dates({"5/12/2023", "5/13/2023"}).order, DateOrder::MonthFirst);
  EXPECT_EQ(order_of_dates({"5/12/2023", "13/12/2023"}).order, DateOrder::DayFirst);
  EXPECT_TRUE(order_of_dates({"5/12/2023", "13/12/2023"}).is_certain);
}

TEST(DateOrder, EvenStepsDecideWhereBothFit) {
  const DatesRead days = order_of_dates({"9/4/2023", "10/4/2023", "11/4/2023", "12/4/2023"});
  EXPECT_EQ(days.order, DateOrder::DayFirst) << "months have 30 and 31 days";
  EXPECT_FALSE(days.is_certain);
  const DatesRead backwards = order_of_dates({"12/1/2023 23:00", "1/2/2023 00:00"});
  EXPECT_EQ(backwards.order, DateOrder::DayFirst) << "from December to January it goes back";
  EXPECT_TRUE(backwards.is_certain);
}

TEST(DateOrder, NothingShowsItOnOneDay) {
  const DatesRead one = order_of_dates({"5/12/2023 10:00", "5/12/2023 10:01"});
  EXPECT_EQ(one.order, DateOrder::MonthFirst);
  EXPECT_FALSE(one.is_certain);
}

TEST(DateOrder, AmAndPmStandBesideMonthsFirst) {
  EXPECT_TRUE(order_of_dates({"05/12/23 11:58:00 AM", "05/12/23 11:59:00 AM"}).is_certain);
}

TEST(DateOrder, DatesWithYearsInFrontHaveOneOrder) {
  EXPECT_TRUE(order_of_dates({"2023-05-12", "12.05.2023", "10:00", "x"}).is_certain);
}

}  // namespace
}  // namespace lacuna
