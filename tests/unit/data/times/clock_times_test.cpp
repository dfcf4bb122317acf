// SPDX-License-Identifier: MIT
#include "data/times/clock_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>

#include "core/base/random.hpp"
#include "data/formats/read_text.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

constexpr Stamp kSecond = kStampOfOne;

/// Times of a log with one column beside them.
Vector times_of(const std::vector<std::string>& clocks) {
  std::string text = "time,x\n";
  for (std::size_t i = 0; i < clocks.size(); ++i)
    text += clocks[i] + "," + std::to_string(i % 3) + "\n";
  return parse_text_table(text, "log.csv").values.col(0);
}

TEST(ClockTimes, DaysAreThoseOfTheCalendar) {
  EXPECT_EQ(read_clock("2000-01-01")->day, 0);
  EXPECT_EQ(read_clock("2000-03-01")->day, 60) << "2000 was a leap year";
  EXPECT_EQ(read_clock("2001-01-01")->day, 366);
  EXPECT_EQ(read_clock("1999/12/31")->day, -1);
  EXPECT_EQ(read_clock("22.11.2026 10:00")->day, read_clock("2026-11-22T10:00:00Z")->day);
}

TEST(ClockTimes, SecondsAreThoseOfTheDay) {
  EXPECT_EQ(read_clock("01:02:03.25")->time, 3723 * kSecond + kSecond / 4);
  EXPECT_EQ(read_clock("01:02:03,25")->time, 3723 * kSecond + kSecond / 4);
  EXPECT_EQ(read_clock("00:00:00.000000000000000001")->time, Stamp{1});
  EXPECT_EQ(read_clock("24:00:00")->time, 86400 * kSecond);
  EXPECT_FALSE(read_clock("10:00")->has_day);
  EXPECT_FALSE(read_clock("2026-11-22")->has_time);
}

TEST(ClockTimes, ZonesAreOneMoment) {
  const Stamp moment = read_clock("2026-11-22T10:30:00Z")->seconds();
  for (const char* text :
       {"2026-11-22 11:30:00+01:00", "2026-11-22 12:30+0200", "2026-11-22T05:30-05",
        "2026-11-22 10:30:00 UTC", "2026-11-22T16:00:00+05:30", "2026-11-23T00:30:00 +1400",
        "22.11.2026 10:30:00 GMT", "2026-11-22 11:30 CET", "2026-11-22 12:30 CEST",
        "2026-11-22 12:30 GMT+2", "2026-11-22 05:30 EST", "2026-11-21T22:30:00-12:00"})
    EXPECT_EQ(read_clock(text)->seconds(), moment) << text;
  EXPECT_FALSE(read_clock("2026-11-22 10:30")->zone);
}

TEST(ClockTimes, OtherTextIsNone) {
  for (const char* text :
       {"", "1.5", "12", "1-2", "2026-11-22x", "1.2.3", "12:30 xm", "a:b", "05-12-23",
        "2026-11-22 10:00 XYZ", "10:00+1", "10:00:00+01:00:00", "22-Foo-2026", "5/12/202"})
    EXPECT_FALSE(read_clock(text)) << text;
}

TEST(ClockTimes, DatesAreWrittenInManyWays) {
  const auto day = read_clock("2026-11-05")->day;
  for (const char* text : {"11/05/2026", "11/5/26", "5.11.26", "05-Nov-2026", "5 Nov 2026",
                           "11-05-2026", "5/NOV/26"})
    EXPECT_EQ(read_clock(text)->day, day) << text;
  for (const char* text : {"05/11/2026", "5/11/26", "05-11-2026", "5.11.2026"})
    EXPECT_EQ(read_clock(text, DateOrder::DayFirst)->day, day) << text;
  EXPECT_EQ(read_clock("1 Mai 2026")->day, read_clock("2026-05-01")->day);
}

TEST(ClockTimes, HoursOfHalfDays) {
  EXPECT_EQ(read_clock("12:30 AM")->time, 1800 * kSecond);
  EXPECT_EQ(read_clock("12:30 pm")->time, (12 * 3600 + 1800) * kSecond);
  EXPECT_EQ(read_clock("1:00:00.5 p.m.")->time, 13 * 3600 * kSecond + kSecond / 2);
  EXPECT_EQ(read_clock("11/05/2026 11:00 PM CET")->seconds(),
            read_clock("2026-11-05T22:00Z")->seconds());
  for (const char* text : {"13:00 PM", "0:10 AM"})
    EXPECT_FALSE(read_clock(text)->problem.empty()) << text;
}

TEST(ClockTimes, ThousandthsMayStandBehindAColon) {
  EXPECT_EQ(read_clock("10:00:01:250")->time, 36001 * kSecond + kSecond / 4);
  EXPECT_FALSE(read_clock("10:00:01:25")) << "that may be frames";
}

TEST(ClockTimes, TimesThatThereAreNotHaveAProblem) {
  for (const char* text :
       {"2026-02-30", "2026-02-29 10:00", "2100-02-29", "2026-04-31T00:00", "2026-13-01",
        "2026-00-10", "2026-11-00", "32.01.2026", "25:00", "24:00:01", "10:60", "10:00:61",
        "10:00:60Z", "2026-11-22T23:59:60+05:00", "10:00:60", "10:00+15:00", "10:00+01:75"}) {
    const auto clock = read_clock(text);
    ASSERT_TRUE(clock) << text;
    EXPECT_FALSE(clock->problem.empty()) << text;
  }
  for (const char* text : {"2024-02-29", "2000-02-29 23:59", "24:00", "23:59:60Z",
                           "2016-12-31T23:59:60.5Z", "2017-01-01T05:29:60+05:30", "12:59:60"})
    EXPECT_EQ(read_clock(text)->problem, "") << text;
}

TEST(ClockTimes, DaysOfAllYearsAreThoseOfTheSystem) {
  Random random(5);
  for (int i = 0; i < 3000; ++i) {
    const auto seconds = static_cast<std::time_t>(random.below(4102444800U));
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    char text[40];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    EXPECT_EQ(read_clock(text)->seconds(), stamp_of(std::int64_t{seconds} - 946684800)) << text;
  }
}

TEST(ClockTimes, TheEndOfDaylightSavingIsNoStepBack) {
  EXPECT_EQ(times_of({"2026-10-25T02:59:58+02:00", "2026-10-25T02:59:59+02:00",
                      "2026-10-25T02:00:00+01:00", "2026-10-25T02:00:01+01:00"}),
            Eigen::Vector4d(0.0, 1.0, 2.0, 3.0));
  EXPECT_EQ(times_of({"2026-03-29T01:59:58+01:00", "2026-03-29T01:59:59+01:00",
                      "2026-03-29T03:00:00+02:00", "2026-03-29T03:00:01+02:00"}),
            Eigen::Vector4d(0.0, 1.0, 2.0, 3.0))
      << "nor is its begin a jump";
  EXPECT_EQ(times_of({"02:59:59+02:00", "02:00:00+01:00", "02:00:01+01:00"}),
            Eigen::Vector3d(0.0, 1.0, 2.0));
}

TEST(ClockTimes, ALeapSecondInTheRecordIsASecond) {
  EXPECT_EQ(times_of({"2016-12-31T23:59:59Z", "2016-12-31T23:59:60Z", "2016-12-31T23:59:60.5Z",
                      "2017-01-01T00:00:00Z"}),
            Eigen::Vector4d(0.0, 1.0, 1.5, 2.0));
  EXPECT_EQ(
      times_of({"1998-12-31T23:59:59Z", "1998-12-31T23:59:60.5Z", "1999-01-01T00:00:00Z"}),
      Eigen::Vector3d(0.0, 1.5, 2.0));
}

TEST(ClockTimes, DigitsBelowNanosecondsAreKept) {
  EXPECT_EQ(
      times_of({"2026-11-22T10:00:00.0000000000001Z", "2026-11-22T10:00:00.0000000000003Z",
                "2026-11-22T10:00:00.0000000000005Z"}),
      Eigen::Vector3d(0.0, 2e-13, 4e-13));
}

TEST(ClockTimes, AZoneInAFieldOfItsOwnIsNoNumber) {
  const Table table = parse_text_table(
      "2026-10-25 02:59:59 +0200 1.5\n2026-10-25 02:00:00 +0100 2.5\n"
      "2026-10-25 02:00:01 +0100 3.5\n",
      "log.txt");
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.values.col(0), Eigen::Vector3d(0.0, 1.0, 2.0));
  EXPECT_EQ(table.values.col(1), Eigen::Vector3d(1.5, 2.5, 3.5));
}

TEST(ClockTimes, ANumberBehindATimeIsNoZone) {
  const Table signs = parse_text_table("10:00:00,-12,7\n10:00:01,-11,8\n10:00:02,+10,9\n", "a");
  EXPECT_EQ(signs.values.col(1), Eigen::Vector3d(-12.0, -11.0, 10.0));
  const Table counts = parse_text_table(
      "2026-10-25 10:00:00 -1200 7\n2026-10-25 10:00:01 -1201 8\n2026-10-25 10:00:02 35 9\n",
      "a");
  ASSERT_EQ(counts.columns.size(), 3u);
  EXPECT_EQ(counts.values.col(1), Eigen::Vector3d(-1200.0, -1201.0, 35.0));
}

TEST(ClockTimes, WhatCannotBeIsToldWithItsLine) {
  const std::string good = "2026-02-27 10:00:00,1\n2026-02-28 10:00:00,2\n";
  const auto refused = [&](const std::string& line, const std::string& problem) {
    expect_error<DataError>(
        [&] { parse_text_table("time,x\n" + good + line + ",3\n", "log.csv"); }, "log.csv:4:1",
        problem, "");
  };
  refused("2026-02-30 10:00:00", "month 2 of 2026 has 28 days");
  refused("2026-03-01 25:00:00", "a day ends at 24:00");
  refused("2026-03-01 10:00:61", "a minute has no second 61");
  refused("2026-03-01 10:00:00Z", "it has a zone, others have none");
  refused("10:00:00", "it has no date, others have one");
  expect_error<DataError>(
      [] {
        parse_text_table("time,x\n2026-02-30 10:00:00,1\n2026-03-01 10:00:00,2\n", "a.csv");
      },
      "a.csv:2:1", "month 2 of 2026 has 28 days", "");
  expect_error<DataError>(
      [&] {
        parse_text_table("Date,Time,x\n2026-02-27,10:00,1\n2026-02-27,10:77,1\n", "a.csv");
      },
      "a.csv:3:1", "there is no minute 77", "");
}

}  // namespace
}  // namespace lacuna
