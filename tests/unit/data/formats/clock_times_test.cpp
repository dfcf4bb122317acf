// SPDX-License-Identifier: MIT
#include "data/formats/clock_times.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(ClockTimes, DaysAreThoseOfTheCalendar) {
  EXPECT_EQ(read_clock("2000-01-01")->day, 0.0);
  EXPECT_EQ(read_clock("2000-03-01")->day, 60.0) << "2000 was a leap year";
  EXPECT_EQ(read_clock("2001-01-01")->day, 366.0);
  EXPECT_EQ(read_clock("1999/12/31")->day, -1.0);
  EXPECT_EQ(read_clock("22.11.2026 10:00")->day, read_clock("2026-11-22T10:00:00Z")->day);
}

TEST(ClockTimes, SecondsAreThoseOfTheDay) {
  EXPECT_DOUBLE_EQ(read_clock("01:02:03.25")->seconds, 3723.25);
  EXPECT_DOUBLE_EQ(read_clock("01:02:03,25")->seconds, 3723.25);
  EXPECT_DOUBLE_EQ(read_clock("2026-11-22 10:30:00+01:00")->seconds, 37800.0);
  EXPECT_FALSE(read_clock("10:00")->has_day);
  EXPECT_FALSE(read_clock("2026-11-22")->has_time);
}

TEST(ClockTimes, OtherTextIsNone) {
  for (const char* text : {"", "1.5", "12", "1-2", "10:99", "25:00:61", "2026-13-01",
                           "2026-11-22x", "1.2.3", "12:30 pm", "a:b"})
    EXPECT_FALSE(read_clock(text)) << text;
}

}  // namespace
}  // namespace lacuna
