// SPDX-License-Identifier: MIT
#include "data/records/split.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "data/formats/read_text.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using testing::expect_error;
using ::testing::HasSubstr;
using ::testing::SizeIs;

Records split(const std::string& text, const ColumnRoles& roles = {}) {
  const Table table = parse_text_table(text, "a.csv");
  return split_records(table, find_columns(table, roles));
}

/// "first+count first+count ..." of the ranges.
std::string ranges_of(const Records& records) {
  std::vector<std::string> texts;
  for (const TableRows& range : records.ranges)
    texts.push_back(std::to_string(range.first) + "+" + std::to_string(range.count));
  return join(texts, " ");
}

/// A record with these times.
std::string at_times(const std::vector<double>& times) {
  std::string text = "t,x\n";
  for (const double time : times) text += format_number(time) + ",1\n";
  return text;
}

std::vector<double> uniform_times(int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(0.1 * i);
  return times;
}

TEST(Split, AMissingValueCutsAndIsNoted) {
  const Records records = split("t,x,y\n0,1,1\n1,1,1\n2,,1\n3,nan,\n4,1,1\n5,1,1\n");
  EXPECT_EQ(ranges_of(records), "0+2 4+2");
  EXPECT_THAT(records.notes,
              ElementsAre("a.csv:4:2: value of 'x' missing, 2 rows left out, record split"));
}

TEST(Split, AMissingValueInAColumnWithoutRoleIsIgnored) {
  EXPECT_EQ(ranges_of(split("t,x,y\n0,1,\n1,1,\n2,1,3\n", {.states = {"x"}})), "0+3");
}

TEST(Split, MissingValuesAtTheEndsDoNotCut) {
  const Records records = split("t,x\n0,\n1,1\n2,1\n3,\n");
  EXPECT_EQ(ranges_of(records), "1+2");
  EXPECT_THAT(records.notes, ElementsAre("a.csv:2:2: value of 'x' missing, 1 row left out",
                                         "a.csv:5:2: value of 'x' missing, 1 row left out"));
}

TEST(Split, AJumpInTimeCutsAndIsNoted) {
  std::vector<double> times = uniform_times(20);
  for (std::size_t i = 12; i < 20; ++i) times[i] += 5.0;
  const Records records = split(at_times(times));
  EXPECT_EQ(ranges_of(records), "0+12 12+8");
  EXPECT_THAT(records.notes, ElementsAre(HasSubstr("a.csv:14:1: record split, time jumps")));
}

TEST(Split, ASingleLostSampleIsAJump) {
  std::vector<double> times = uniform_times(20);
  times.erase(times.begin() + 7);
  EXPECT_EQ(ranges_of(split(at_times(times))), "0+7 7+12");
}

TEST(Split, ARowAloneBetweenCutsIsDroppedAndNoted) {
  const Records records = split("t,x\n0,1\n1,1\n2,\n3,1\n4,\n5,1\n6,1\n");
  EXPECT_EQ(ranges_of(records), "0+2 5+2");
  EXPECT_THAT(records.notes, ElementsAre(HasSubstr("missing"), HasSubstr("missing"),
                                         HasSubstr("a.csv:5:1: a single row")));
}

TEST(Split, RecordsSampledAtWillAreNotCut) {
  std::vector<double> logarithmic, jittered, alternating;
  Random random(4);
  for (int i = 0; i < 60; ++i) {
    logarithmic.push_back(1e-3 * std::pow(1.2, i));
    jittered.push_back(i + random.uniform(-0.35, 0.35));
    alternating.push_back(i + (i % 2 == 0 ? 0.0 : 0.3));
  }
  EXPECT_EQ(ranges_of(split(at_times(logarithmic))), "0+60");
  EXPECT_EQ(ranges_of(split(at_times(jittered))), "0+60");
  EXPECT_EQ(ranges_of(split(at_times(alternating))), "0+60");
}

TEST(Split, AJitteredRecordIsCutAtALongGap) {
  std::vector<double> times;
  Random random(5);
  for (int i = 0; i < 60; ++i)
    times.push_back(i + random.uniform(-0.2, 0.2) + (i < 40 ? 0.0 : 50.0));
  EXPECT_EQ(ranges_of(split(at_times(times))), "0+40 40+20");
}

TEST(Split, ANewTrajectoryNumberCutsAndTimeStartsAgain) {
  const Records records =
      split("run,t,x\n7,0,1\n7,1,1\n3,0,1\n3,1,1\n3,2,1\n", {.trajectory = "run"});
  EXPECT_EQ(ranges_of(records), "0+2 2+3");
  EXPECT_THAT(records.notes, ElementsAre("a.csv: 2 records by column 'run'"));
}

TEST(Split, NotesAreCapped) {
  std::string text = "t,x\n";
  for (int i = 0; i < 300; ++i) text += std::to_string(i) + (i % 3 == 2 ? ",\n" : ",1\n");
  const Records records = split(text);
  EXPECT_EQ(records.ranges.size(), 100u);
  ASSERT_THAT(records.notes, SizeIs(11));
  EXPECT_EQ(records.notes.back(), "a.csv: 90 more places like these");
}

TEST(Split, RefusesTimeThatGoesBackwards) {
  expect_error<DataError>([] { split("t,x\n0,1\n2,1\n1,1\n"); }, "a.csv:4:1",
                          "goes backwards, from 2 to 1", "sort the lines");
  expect_error<DataError>([] { split("t,x\n0,1\n2,1\n3,\n1,1\n2,1\n"); }, "a.csv:5:1",
                          "goes backwards, from 3 to 1", "--trajectory NAME");
  expect_error<DataError>([] { split("x,y\n0,1\n2,1\n1,1\n"); }, "a.csv:4:1", "goes backwards",
                          "the first column was taken as the time");
}

TEST(Split, RefusesInfiniteValues) {
  expect_error<DataError>([] { split("t,x\n0,1\n1,inf\n2,1\n"); }, "a.csv:3:2",
                          "the value in column 'x' is infinite", "remove the line");
  expect_error<DataError>([] { split("t,x\n0,1\n1e999,1\n"); }, "a.csv:3:1", "column 't'",
                          "remove the line");
}

TEST(Split, RefusesWhatLeavesNoRecord) {
  expect_error<DataError>([] { split("t,x\n0,1\n"); }, "a.csv", "only one line of numbers",
                          "at least two samples");
  expect_error<DataError>([] { split("t,x\n0,1\n1,\n2,1\n"); }, "a.csv", "no two lines",
                          "at least two samples");
  expect_error<DataError>([] { split("t,x,y\n0,1,\n1,1,\n"); }, "a.csv, column 3",
                          "column 'y' has no values", "remove it");
  expect_error<DataError>([] { split("run,t,x\n1,0,1\n,1,1\n", {.trajectory = "run"}); },
                          "a.csv:3:1", "number of the record is missing", "every line");
}

TEST(SplitRecords, NumbersOfRecordsThatDoublesDoNotTellApartAreRefused) {
  expect_error<DataError>(
      [] {
        split("run,t,x\n1,0,1\n1,1,1\n9007199254740993,0,1\n9007199254740992,1,1\n",
              {.trajectory = "run"});
      },
      "a.csv:4:1", "more digits than doubles hold", "number the records from 1");
}

}  // namespace
}  // namespace lacuna
