// SPDX-License-Identifier: MIT
// What is said of times. Times in files: unit/data/long_records/exact_times_test.cpp.
#include "data/times/counted_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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
