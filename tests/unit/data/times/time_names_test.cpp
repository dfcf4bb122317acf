// SPDX-License-Identifier: MIT
#include "data/times/time_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "data/times/counted_times.hpp"
#include "data/times/date_order.hpp"
#include "data/times/stamps.hpp"

namespace lacuna {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(TimeNames, UnitsHaveManyNames) {
  for (const auto& [text, symbol] :
       std::vector<std::pair<std::string, std::string>>{{"ms", "ms"},
                                                        {"[ms]", "ms"},
                                                        {"(us)", "us"},
                                                        {"\u00b5s", "us"},
                                                        {"Seconds", "s"},
                                                        {"msec", "ms"},
                                                        {"min", "min"},
                                                        {"hours", "h"},
                                                        {" nanos ", "ns"},
                                                        {"Sekunden", "s"},
                                                        {"d", "d"}})
    EXPECT_EQ(time_unit_symbol(text), symbol) << text;
  for (const char* text : {"", "V", "m", "mV", "rpm", "x", "s s", "1/s"})
    EXPECT_FALSE(time_unit_symbol(text)) << text;
}

TEST(TimeNames, ANameThatEndsInAUnitSaysIt) {
  for (const auto& [name, unit] :
       std::vector<std::pair<std::string, std::string>>{{"time_ms", "ms"},
                                                        {"Time in ms", "ms"},
                                                        {"millis", "ms"},
                                                        {"t_us", "us"},
                                                        {"timestamp_ns", "ns"},
                                                        {"timestampNs", "ns"},
                                                        {"Time, ms", "ms"},
                                                        {"t / s", "s"},
                                                        {"elapsed_h", "h"},
                                                        {"time_min", "min"},
                                                        {"Zeit_s", "s"},
                                                        {"t_s", "s"},
                                                        {"Time \u00b5s", "us"},
                                                        {"seconds", "s"},
                                                        {"field.header.stamp.nsec", "ns"},
                                                        {"uptime_d", "d"},
                                                        {"ms", "ms"}}) {
    const auto found = unit_in_name(name);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(found->unit, unit) << name;
    EXPECT_TRUE(found->is_certain) << name;
  }
}

TEST(TimeNames, WordsWithOtherMeaningsAreNotCertain) {
  for (const char* name : {"t_min", "x_h", "h", "min", "t_d", "d", "time_m"}) {
    const auto found = unit_in_name(name);
    ASSERT_TRUE(found) << name;
    EXPECT_FALSE(found->is_certain) << name;
  }
}

TEST(TimeNames, OtherNamesSayNothing) {
  for (const char* name : {"", "t", "time", "Time", "timestamp", "x", "volts", "rms", "items",
                           "forms", "th", "_", "time_mm", "params"})
    EXPECT_FALSE(unit_in_name(name)) << name;
}

constexpr Stamp kMicro = kStampOfOne / 1'000'000;

std::vector<Stamp> evenly(Stamp first, Stamp step, int count = 20) {
  std::vector<Stamp> times;
  for (int i = 0; i < count; ++i) times.push_back(first + i * step);
  return times;
}

TEST(Stamps, AreTheDigitsThatAreWritten) {
  EXPECT_EQ(read_stamp("1700000000.123456"), 1700000000123456 * kMicro);
  EXPECT_EQ(read_stamp("1700000000,123456"), 1700000000123456 * kMicro);
  EXPECT_EQ(read_stamp("+1.7e9"), 1700000000 * kStampOfOne);
  EXPECT_EQ(read_stamp("-0.000000000000000001"), Stamp{-1});
  EXPECT_EQ(read_stamp("1.5E-18"), Stamp{2}) << "half away from zero";
  EXPECT_EQ(read_stamp("1.700000000123456789e+09"), read_stamp("1700000000.123456789"));
  EXPECT_EQ(read_stamp("18446744073709551615"),
            stamp_of(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_EQ(read_stamp("000000000000000000000000000000000000000000007"), stamp_of(7));
  EXPECT_EQ(read_stamp("0.3333333333333333333333333333333333333333333333"), kStampOfOne / 3);
}

TEST(Stamps, OtherTextIsNone) {
  for (const char* text : {"", "-", ".", "e5", "nan", "inf", "1.2.3", "1,2,3", "12:30", "1e",
                           "1e+-3", "0x10", "1 2", "18446744073709551616", "1e300", "1e99999"})
    EXPECT_FALSE(read_stamp(text)) << text;
  EXPECT_EQ(read_stamp("0e300"), Stamp{0});
}

TEST(Stamps, TheirTextReadsBack) {
  EXPECT_EQ(stamp_text(*read_stamp("1700000000.000001")), "1700000000.000001");
  EXPECT_EQ(stamp_text(*read_stamp("-0.5")), "-0.5");
  EXPECT_EQ(stamp_text(0), "0");
  EXPECT_EQ(stamp_text(stamp_of(100)), "100");
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    Stamp stamp = static_cast<std::int64_t>(random.below(~std::uint64_t{0}));
    stamp *= static_cast<std::int64_t>(random.below(~std::uint64_t{0}) >> 5U);
    EXPECT_EQ(read_stamp(stamp_text(stamp)), stamp) << stamp_text(stamp);
  }
}

TEST(Stamps, BecomeTheNearestDouble) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const Stamp stamp = static_cast<Stamp>(random.below(~std::uint64_t{0})) *
                        static_cast<std::int64_t>(random.below(~std::uint64_t{0}) >> 4U);
    const std::string text = stamp_text(stamp / 16);
    EXPECT_EQ(value_of(stamp / 16), *parse_number(text)) << text;
  }
  EXPECT_EQ(value_of(kMicro), 1e-6);
  EXPECT_EQ(value_of(stamp_of(100)), 100.0);
}

TEST(Stamps, ADoubleHasANearestStamp) {
  EXPECT_EQ(nearest_stamp(0.5), kStampOfOne / 2);
  EXPECT_EQ(nearest_stamp(-3.0), stamp_of(-3));
  EXPECT_EQ(nearest_stamp(0.1), kStampOfOne / 10 + 6) << "0.10000000000000000555";
  EXPECT_EQ(nearest_stamp(1.7e18), stamp_of(std::int64_t{1'700'000'000'000'000'000}));
  EXPECT_EQ(nearest_stamp(1e-40), Stamp{0});
  EXPECT_EQ(nearest_stamp(0.0), Stamp{0});
}

TEST(Stamps, TimesThatDoublesHoldKeepTheirOrigin) {
  EXPECT_FALSE(origin_of({}));
  EXPECT_FALSE(origin_of(evenly(0, kMicro)));
  EXPECT_FALSE(origin_of(evenly(*read_stamp("5.01"), kStampOfOne / 100)));
  EXPECT_FALSE(origin_of(evenly(stamp_of(100'000), kStampOfOne / 1000))) << "a day at 1 kHz";
  EXPECT_FALSE(origin_of(evenly(stamp_of(1'700'000'000), kStampOfOne))) << "1970, seconds";
  EXPECT_FALSE(origin_of(evenly(stamp_of(1'700'000'000'000), kStampOfOne))) << "milliseconds";
  EXPECT_FALSE(origin_of(evenly(stamp_of(1'700'000'000'000'000), kStampOfOne)))
      << "whole microseconds are below 2^53";
}

TEST(Stamps, OthersAreCountedFromTheFirst) {
  const Stamp nanoseconds = stamp_of(std::int64_t{1'700'000'000'123'456'789});
  EXPECT_EQ(origin_of(evenly(nanoseconds, stamp_of(100))), nanoseconds);
  EXPECT_EQ(origin_of(evenly(nanoseconds, stamp_of(86'400'000'000'000))), nanoseconds);
  const Stamp written = *read_stamp("1700000000.123456");
  EXPECT_EQ(origin_of(evenly(written, kMicro)), written) << "rounded to a quarter of the step";
  const Stamp digits = *read_stamp("1700000000.123456789");
  EXPECT_EQ(origin_of(evenly(digits, 3600 * kStampOfOne)), digits) << "digits are lost";
}

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

// What is said of times. Times in files: unit/data/long_records/exact_times_test.cpp.
Table table_with(const Vector& times) {
  Table table;
  table.source = "a.npy";
  name_columns(table, {{"t", ""}, {"x", ""}}, std::nullopt);
  table.values.resize(times.size(), 2);
  table.values << times, times;
  return table;
}

/// Notes on times that are written with so many decimals.
std::vector<std::string> notes_of(double step, int decimals, double jitter = 0.0) {
  Table table = table_with(Vector::Zero(2));
  std::vector<Stamp> stamps;
  const double unit = std::pow(10.0, decimals);
  for (int i = 0; i < 200; ++i) {
    const double time = step * i + jitter * std::sin(i * i);
    stamps.push_back(static_cast<Stamp>(std::llround(time * unit)) * kStampOfOne /
                     static_cast<Stamp>(unit));
  }
  look_at_times(table, {0, true}, stamps);
  return table.notes;
}

TEST(CountedTimes, RoundingThatIsCoarseForTheStepIsSaid) {
  EXPECT_THAT(notes_of(0.0014, 3),
              ElementsAre("a.npy: the times in column 't' are rounded to 0.001, 100 % of "
                          "their step; write them with more digits, or give the step"));
  EXPECT_THAT(notes_of(1.0 / 30.0, 3), ElementsAre(HasSubstr("are rounded to 0.001, 3 %")));
  EXPECT_THAT(notes_of(1.0 / 30.0, 5), IsEmpty()) << "0.03 % of the step";
  EXPECT_THAT(notes_of(0.002, 3), IsEmpty()) << "an even step of two units";
  EXPECT_THAT(notes_of(0.05, 3, 0.02), IsEmpty()) << "sampled at will";
}

TEST(CountedTimes, AUnitThatNobodySaysIsTheFirstNote) {
  Table table = table_with(Vector::Zero(2));
  table.notes = {"a.npy: column 'mode' is text and left out"};
  const Stamp begin = static_cast<Stamp>(1700000000123456789) * kStampOfOne;
  const std::vector<Stamp> stamps{begin, begin + kStampOfOne};
  look_at_times(table, {0, false}, stamps);
  EXPECT_THAT(table.notes.at(0), HasSubstr("give --time-unit ns"));
}

TEST(CountedTimes, FloatingNumbersHaveAResolutionToo) {
  const auto notes = [](double origin, double step, double epsilon) {
    Vector times(200);
    for (Index i = 0; i < times.size(); ++i) {
      times[i] = origin + step * static_cast<double>(i);
      if (epsilon > 1e-10) times[i] = static_cast<double>(static_cast<float>(times[i]));
    }
    Table table = table_with(times);
    count_times(table, {0, true}, {{}, epsilon});
    EXPECT_EQ(table.values.col(0), times) << "nothing can be gained by counting";
    return table.notes;
  };
  constexpr double kDouble = 0x1p-52, kSingle = 0x1p-23;
  EXPECT_THAT(notes(1.7e9, 1.1e-6, kDouble), ElementsAre(HasSubstr("rounded to 2.4e-07")));
  EXPECT_THAT(notes(1000.0, 1.13e-3, kSingle), ElementsAre(HasSubstr("rounded to 6.1e-05")));
  EXPECT_THAT(notes(1.7e9, 1e-3, kDouble), IsEmpty());
  EXPECT_THAT(notes(0.0, 1.1e-3, kDouble), IsEmpty());
}

TEST(CountedTimes, TimesSince1970WithoutAUnitAreSaid) {
  const auto notes = [](std::int64_t first, bool has_unit) {
    Table table = table_with(Vector::Zero(2));
    look_at_times(table, {0, has_unit}, std::vector<Stamp>{stamp_of(first)});
    return table.notes;
  };
  const std::int64_t seconds = 1'700'000'000;
  EXPECT_THAT(notes(seconds, false), IsEmpty());
  EXPECT_THAT(notes(seconds * 1000, false),
              ElementsAre(AllOf(HasSubstr("milliseconds since 1970 (year 2023)"),
                                HasSubstr("--time-unit ms"))));
  EXPECT_THAT(notes(seconds * 1'000'000, false), ElementsAre(HasSubstr("--time-unit us")));
  EXPECT_THAT(notes(seconds * 1'000'000'000, false),
              ElementsAre(HasSubstr("--time-unit ns"), HasSubstr("counted from")));
  EXPECT_THAT(notes(seconds * 1000, true), IsEmpty());
}

TEST(CountedTimes, TheTimeIsFoundBeforeRowsAreRead) {
  Table columns;
  columns.source = "a.csv";
  name_columns(columns, {{"x", ""}, {"stamp", ""}, {"t [ms]", "ms"}}, std::nullopt);
  EXPECT_EQ(time_finder({})(columns)->column, 0);
  EXPECT_FALSE(time_finder({})(columns)->has_unit);
  EXPECT_EQ(time_finder({.time = "stamp"})(columns)->column, 1);
  EXPECT_TRUE(time_finder({.time = "stamp", .time_unit = "ns"})(columns)->has_unit);
  EXPECT_EQ(time_finder({.names = {{"t", "stamp"}}})(columns)->column, 1);
  EXPECT_FALSE(time_finder({.step = 0.1})(columns));
  EXPECT_FALSE(time_finder({.time = "none"})(columns)) << "which is said later";
}

}  // namespace
}  // namespace lacuna
