// SPDX-License-Identifier: MIT
#include "data/logs/joined_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "data/formats/read_text.hpp"
#include "data/logs/damage.hpp"
#include "data/logs/range_ends.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// The table of two files.
Table joined(const std::string& a, const std::string& b, const ColumnRoles& roles = {}) {
  const TemporaryFolder folder;
  return read_table(folder.write("a.csv", a) + "+" + folder.write("b.csv", b), roles);
}

std::vector<std::string> names_in(const Table& table) { return names_of(table.columns); }

TEST(JoinedOnTime, ThereIsARowForEachTime) {
  const Table table = joined("t [s],x [V]\n0,1\n1,2\n2,3\n", "u,t [s]\n10,0.5\n20,1\n30,1.5\n");
  EXPECT_THAT(names_in(table), ElementsAre("t", "x", "u"));
  EXPECT_TRUE(table.own_times);
  ASSERT_EQ(table.values.rows(), 5);
  for (Index i = 0; i < 5; ++i) EXPECT_EQ(table.values(i, 0), 0.5 * static_cast<double>(i));
  EXPECT_EQ(table.values(2, 1), 2.0);
  EXPECT_EQ(table.values(2, 2), 20.0);
  EXPECT_TRUE(std::isnan(table.values(1, 1)));
  EXPECT_TRUE(std::isnan(table.values(0, 2)));
  EXPECT_EQ(table.values(3, 2), 30.0);
}

TEST(JoinedOnTime, UnitsOfTimeAreBroughtToOne) {
  // 300 ms are 0.3 s but for the last digit of doubles.
  const Table table = joined("t [s],x\n0.1,1\n0.2,2\n0.3,3\n",
                             "time_ms,u\n100,1\n200,2\n300,3\n");
  EXPECT_EQ(table.values.rows(), 3);
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_FALSE(table.values.array().isNaN().any());
  const Table one = joined("t [ms],x\n100,1\n200,2\n", "t,u\n100,1\n200,2\n");
  EXPECT_EQ(one.values.rows(), 2);
  EXPECT_EQ(one.columns[0].unit, "ms");
  EXPECT_THAT(one.notes, Contains(HasSubstr("taken to be in ms")));
}

TEST(JoinedOnTime, ClocksAndCountedTimesHaveOneBegin) {
  const Table clocks =
      joined("time,x\n10:00:00.0,1\n10:00:00.5,2\n10:00:01.0,3\n10:00:01.5,4\n",
             "time,u\n10:00:00.5,1\n10:00:01.0,2\n10:00:01.5,3\n10:00:02.0,4\n");
  ASSERT_EQ(clocks.values.rows(), 5);
  EXPECT_EQ(clocks.values(1, 2), 1.0);
  EXPECT_EQ(clocks.values(4, 0), 2.0);
  const Table counted = joined("t [ns],x\n1700000000000000000,1\n1700000000001000000,2\n",
                               "t [ns],u\n1700000000001000000,5\n1700000000002000000,6\n");
  ASSERT_EQ(counted.values.rows(), 3);
  EXPECT_NEAR(counted.values(1, 0), 1e6, 1e3);
  EXPECT_EQ(counted.values(1, 2), 5.0);
}

TEST(JoinedOnTime, ColumnsWithoutNamesAreCounted) {
  EXPECT_THAT(names_in(joined("0,1\n1,2\n", "0,5\n1,6\n")), ElementsAre("c1", "c2", "c4"));
}

TEST(JoinedOnTime, SaysWhatDoesNotFit) {
  const auto refused = [](const std::string& a, const std::string& b, const std::string& problem,
                          const std::string& remedy, const ColumnRoles& roles = {}) {
    try {
      joined(a, b, roles);
      ADD_FAILURE() << "nothing was refused: " << problem;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(problem));
      EXPECT_THAT(error.what(), HasSubstr(remedy));
    }
  };
  const std::string plain = "t [s],x\n0,1\n1,2\n";
  refused(plain, "t [s],x\n0,1\n1,2\n", "'x' stands in", "rename it in one of them");
  refused(plain, "t [s],u\n10,1\n11,2\n", "have none in common", "one origin");
  refused(plain, "t [s],u\n1,1\n0,2\n", "b.csv:3:1: time goes backwards", "sort the lines");
  refused(plain, "t [V],u\n0,1\n1,2\n", "its time is in V", "units of time");
  refused(plain, "t,u\n10:00:00,1\n10:00:01,2\n", "those of a clock", "one origin");
  refused(plain, "t,u,run\n0,1,1\n1,2,1\n", "are not numbered", "one by one",
          {.trajectory = "run"});
  refused(plain, "u\n1\n2\n", "joined on their times", "leave it out", {.step = 0.1});
}

/// So many lines of numbers below a header.
std::string lines_of_numbers(int count) {
  std::string text = "t,x\n";
  for (int i = 0; i < count; ++i)
    text += std::to_string(i) + "," + std::to_string(i % 7) + "\n";
  return text;
}

Table read(const std::string& text) { return parse_text_table(text, "a.csv"); }

TEST(Damage, ALineThatCannotBeReadIsAnErrorWhereBytesAreWhole) {
  testing::expect_error<DataError>([] { read(lines_of_numbers(900) + "900,ERR\n901,3\n"); },
                                   "a.csv:902:2", "'ERR'", "");
  testing::expect_error<DataError>([] { read(lines_of_numbers(900) + "900\n901,3\n"); },
                                   "a.csv:902:2", "1 field", "");
}

TEST(Damage, WhereBytesAreDamagedPartsOfLinesAreLostToo) {
  const Table table = read(lines_of_numbers(150) +
                           "150,\xff"
                           "2\n151,ERR\n152,3\n");
  EXPECT_EQ(table.values.rows(), 151);
  ASSERT_EQ(table.notes.size(), 2u);
  EXPECT_THAT(table.notes[1], HasSubstr("a.csv:153: 1 line that cannot be read, left out, here "
                                        "'151,ERR'"));
}

TEST(Damage, StrayBytesMayBeInMoreLines) {
  const Table table = read(
      "t,x\n0,1\n1,\xff"
      "2\n" +
      lines_of_numbers(30).substr(4));
  EXPECT_EQ(table.values.rows(), 31);
  ASSERT_EQ(table.notes.size(), 1u);
  EXPECT_THAT(table.notes[0], HasSubstr("a.csv:3: 1 line with bytes that no text has"));
  testing::expect_error<DataError>(
      [] {
        read(
            "t,x\n0,1\n1,\xff"
            "2\n2,3\n");
      },
      "a.csv:3:2", "", "");
}

TEST(Damage, ALastLineWithoutAnEndMayBeCut) {
  const Table table = read(lines_of_numbers(20) + "20");
  EXPECT_EQ(table.values.rows(), 20);
  ASSERT_EQ(table.notes.size(), 1u);
  EXPECT_THAT(table.notes[0], HasSubstr("1 line cut off at the end"));
  testing::expect_error<DataError>([] { read(lines_of_numbers(20) + "20\n"); }, "a.csv:22:2",
                                   "1 field", "");
}

TEST(Damage, ASummaryEndsTheRecord) {
  const Table table =
      read("Zeit;x\n0,0;1,5\n0,1;2,5\n0,2;3,5\n;\nMittelwert;2,5\nMax.;3,5\n\nStabw;eins\n");
  EXPECT_EQ(table.values.topRows(3).col(1), Eigen::Vector3d(1.5, 2.5, 3.5));
  ASSERT_EQ(table.notes.size(), 1u);
  EXPECT_THAT(table.notes[0],
              HasSubstr("a.csv:6: the record ends in front of 'Mittelwert;2,5', "
                        "3 lines of a summary left out"));
  testing::expect_error<DataError>([] { read("t;x\n0;1\nSumme;2\n1;1\n"); }, "a.csv:3:1",
                                   "'Summe'", "");
  testing::expect_error<DataError>([] { read("t;x\n0;1\n1;1\nfoo;2\n"); }, "a.csv:4:1", "'foo'",
                                   "");
}

TEST(RangeEnds, InfinityOfAnOscilloscopeIsTheEndOfTheRange) {
  for (const std::string sign : {"\u221e", "Infinity"}) {
    const Table table =
        parse_text_table("Time,Channel A,Channel B\n(ms),(V),(mV)\n\n0.0," + sign +
                             ",1\n0.1,1.5,2\n0.2,-2.5,3\n0.3,-" + sign + ",4\n",
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
