// SPDX-License-Identifier: MIT
// Files as loggers write them, read as tables.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/formats/read_text.hpp"
#include "data/formats/text_rows.hpp"
#include "data/times/counted_times.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Table table_of(const std::string& text) { return parse_text_table(text, "log.csv"); }

/// Names with units: "x [V]".
std::vector<std::string> columns_of(const Table& table) {
  std::vector<std::string> names;
  for (const Quantity& column : table.columns)
    names.push_back(column.name + (column.unit.empty() ? "" : " [" + column.unit + "]"));
  return names;
}

std::string notes_of(const Table& table) {
  std::string all;
  for (const std::string& note : table.notes) all += note + "\n";
  return all;
}

TEST(LogDialect, Hobo) {
  const Table table = table_of(
      "\"Plot Title: 1020\"\n\"#\",\"Date Time, GMT+01:00\",\"Temp, \u00b0C (LGR S/N: 1020, SEN "
      "S/N: 1020, LBL: Tank)\",\"RH, % (LGR S/N: 1020)\",\"Host Connected\"\n"
      "1,05/12/23 11:58:00 AM,20.5,51.0,\n2,05/12/23 11:59:00 AM,20.6,51.5,\n"
      "3,05/12/23 12:00:00 PM,20.8,52.0,\n4,05/12/23 01:00:00 PM,20.9,53.0,Logged\n");
  EXPECT_THAT(columns_of(table), ElementsAre("t [s]", "Temp [\u00b0C]", "RH [%]"));
  EXPECT_EQ(table.values.col(0), Eigen::Vector4d(0.0, 60.0, 120.0, 3720.0));
  EXPECT_EQ(table.values.col(1), Eigen::Vector4d(20.5, 20.6, 20.8, 20.9));
  EXPECT_THAT(notes_of(table), HasSubstr("column '#' is the number of the line and left out"));
}

TEST(LogDialect, ArduinoMonitor) {
  const Table table =
      table_of("23:59:59.512 -> 1.2,3\n23:59:59.712 -> 1.3,4\n00:00:00.012 -> 1.5,6\n");
  EXPECT_THAT(columns_of(table), ElementsAre("t [s]", "c2", "c3"));
  EXPECT_TRUE(table.values.col(0).isApprox(Eigen::Vector3d(0.0, 0.2, 0.5)));
  EXPECT_EQ(table.values.col(2), Eigen::Vector3d(3.0, 4.0, 6.0));
}

TEST(LogDialect, LabelsInCells) {
  for (const std::string text :
       {"10:00:00 -> x:1.2,y:3\n10:00:01 -> x:1.3,y:4\n10:00:02 -> x:1.5,y:6\n",
        "t:0,x:1.2,y:3\nt:1,x:1.3,y:4\nt:2,x:1.5,y:6\n",
        "t: 0 x: 1.2 y: 3\nt: 1 x: 1.3 y: 4\nt: 2 x: 1.5 y: 6\n",
        "{\"t\": 0, \"x\": 1.2, \"y\": 3}\n{\"t\": 1, \"x\": 1.3, \"y\": 4}\n"
        "{\"t\": 2, \"x\": 1.5, \"y\": 6}\n"}) {
    const Table table = table_of(text);
    ASSERT_EQ(table.columns.size(), 3u) << text;
    EXPECT_EQ(table.columns[0].name, "t") << text;
    EXPECT_EQ(table.columns[1].name, "x") << text;
    EXPECT_EQ(table.values.col(0), Eigen::Vector3d(0.0, 1.0, 2.0)) << text;
    EXPECT_EQ(table.values.col(1), Eigen::Vector3d(1.2, 1.3, 1.5)) << text;
  }
}

TEST(LogDialect, UnitsInCells) {
  const Table table = table_of(
      "Time,u,T\n0 sec,12.3 V,5\u00b0C\n0.5 sec,900 mV,6\u00b0C\n1 sec,12.5 V,7\u00b0C\n");
  EXPECT_THAT(columns_of(table), ElementsAre("Time [s]", "u [V]", "T [\u00b0C]"));
  EXPECT_EQ(table.values.col(0), Eigen::Vector3d(0.0, 0.5, 1.0));
  EXPECT_EQ(table.values.col(1), Eigen::Vector3d(12.3, 0.9, 12.5));
}

TEST(LogDialect, ATopicOfRos) {
  const Table table = table_of(
      "%time,field.header.frame_id,field.x\n1700000000000000000,base_link,1\n"
      "1700000000020000000,base_link,2\n1700000000040000000,base_link,4\n");
  EXPECT_THAT(columns_of(table), ElementsAre("time", "field_x"));
  EXPECT_EQ(table.values.col(1), Eigen::Vector3d(1.0, 2.0, 4.0));
  EXPECT_THAT(notes_of(table), HasSubstr("column 'field.header.frame_id' is text and left out"));
}

TEST(LogDialect, ChannelsWithTheirTimes) {
  const Table table = table_of(
      "Name\tx\tName\ty\nSampleTime[ms]\t10\tSampleTime[ms]\t10\n\n0\t1\t0\t2\n10\t3\t10\t4\n"
      "20\t5\t20\t6\n");
  EXPECT_THAT(columns_of(table), ElementsAre("Time [ms]", "x", "y"));
  EXPECT_EQ(table.values.col(2), Eigen::Vector3d(2.0, 4.0, 6.0));
  EXPECT_THAT(notes_of(table), HasSubstr("all channels have the same times"));
}

TEST(LogDialect, ChannelsWithTimesOfTheirOwn) {
  const Table table = table_of("Time;x;Time;y\n0;1;0;2\n1;3;2;4\n2;5;4;6\n3;7;;\n");
  EXPECT_THAT(columns_of(table), ElementsAre("Time", "x", "y"));
  EXPECT_EQ(table.values.col(0), (Vector{{0.0, 1.0, 2.0, 3.0, 4.0}}));
  EXPECT_EQ(table.values(Eigen::seq(0, 3), 1), Eigen::Vector4d(1.0, 3.0, 5.0, 7.0));
  EXPECT_EQ(table.values({0, 2, 4}, 2), Eigen::Vector3d(2.0, 4.0, 6.0));
  EXPECT_TRUE(table.values({1, 3}, 2).array().isNaN().all());
  EXPECT_THAT(notes_of(table), HasSubstr("a row for each of the 5 times"));
}

TEST(LogDialect, AChannelWhoseTimesGoBackwardsIsAnError) {
  testing::expect_error<DataError>([] { table_of("Time;x;Time;y\n0;1;0.5;2\n1;3;0.4;4\n"); },
                                   "log.csv:3:3", "goes backwards", "sort its rows");
}

/// Which columns are left out, and what the others are called.
TEST(LogDialect, ColumnsOfEachKind) {
  const std::string times = ",10:00:00,4\n1,10:00:01,5\n";
  const std::pair<std::string, std::vector<std::string>> files[] = {
      {"id,when,mode,u,x,empty\n1,2023-01-01 10:00:00,on,1.5 V,2,\n"
       "2,2023-01-01 10:00:01,off,1.6 V,3,\n5,2023-01-01 10:00:02,on,1.7 V,5,\n",
       {"t [s]", "id", "u [V]", "x"}},
      {",when,x\n0" + times + "2,10:00:02,7\n", {"t [s]", "x"}},
      {",when,x\n0" + times + "4,10:00:02,7\n", {"t [s]", "c2", "x"}},
      {"Time,A,A,B\n,temp,hum,temp\n10:00:00,1,2,3\n10:00:01,2,3,4\n10:00:02,3,4,6\n",
       {"t [s]", "A_temp", "A_hum", "B_temp"}},
      {"Zeit,Winkel,Druck\ns,deg,mbar\n10:00:00,1,2\n10:00:01,2,3\n10:00:02,3,4\n",
       {"t [s]", "Winkel [deg]", "Druck [mbar]"}},
      {"when,x\n2023-01-01,10:00:00,1\n2023-01-01,10:00:01,2\n2023-01-01,10:00:02,4\n",
       {"t [s]", "x"}},
      {"1;25.10.2026;02:59:59;+0200;1,5\n2;25.10.2026;02:00:00;+0100;2,5\n", {"t [s]", "c2"}}};
  for (const auto& [text, names] : files) {
    const Table table = table_of(text);
    EXPECT_EQ(columns_of(table), names) << text;
    EXPECT_EQ(table.values(1, 0), 1.0) << text;
  }
}

/// The second channel ends early: nothing of it is in the lines that show the columns.
TEST(LogDialect, AChannelThatEndsEarlyIsRead) {
  std::string text = "Time;x;Time;y\n";
  for (int i = 0; i < 40; ++i)
    text += std::to_string(i) + ";1;" + (i < 10 ? std::to_string(4 * i) + ";2\n" : ";\n");
  const Table table = table_of(text);
  EXPECT_THAT(columns_of(table), ElementsAre("Time", "x", "y"));
  EXPECT_EQ(table.values.rows(), 40);
  EXPECT_EQ(table.values(36, 2), 2.0);
}

TEST(LogDialect, TimesOfChannelsBeyondDoublesAreCountedFromTheFirst) {
  const std::string text =
      "Time;x;Time;y\n133448448000000001;1;133448448000000002;2\n"
      "133448448000000003;3;133448448000000004;4\n";
  const Table table =
      parse_text(text, "log.csv", [](const Table&) { return TimeColumn{0, true}; });
  EXPECT_EQ(table.values.col(0), Eigen::Vector4d(0.0, 1.0, 2.0, 3.0));
}

TEST(LogDialect, TimesOfManyProgramsInAnyColumn) {
  for (const std::string line :
       {"x,time\n4,2023-12-05 10:00:0# +01:00", "x,time\n4,05-Dec-2023 10:00:0#",
        "x,time\n4,12/5/2023 10:00:0# PM", "x,time\n4,05.12.23 10:00:0#",
        "x,mode,time\n4,on,10:00:0#", "x,time\n4,2023-12-05T10:00:0# CET",
        "x,date,time\n4,2023-12-05,10:00:0#"}) {
    const std::size_t end = line.find('\n') + 1;
    std::string text = line.substr(0, end);
    for (const char second : {'0', '1', '3'}) {
      std::string row = line.substr(end);
      row.replace(row.find('#'), 1, 1, second);
      text += row + "\n";
    }
    const Table table = table_of(text);
    EXPECT_THAT(columns_of(table), ElementsAre("t [s]", "x")) << text;
    EXPECT_EQ(table.values.col(0), Eigen::Vector3d(0.0, 1.0, 3.0)) << text;
  }
}

TEST(LogDialect, TheOrderOfDatesIsThatOfTheFile) {
  const std::string rows = "10/5/2023,1\n11/5/2023,2\n12/5/2023,3\n";
  EXPECT_EQ(table_of("date,x\n" + rows + "13/5/2023,4\n").values(3, 0), 3 * 86400.0);
  EXPECT_EQ(table_of("date,x\n" + rows + "12/25/2023,4\n").values(3, 0), 81 * 86400.0)
      << "5 October to 25 December";
  EXPECT_THAT(notes_of(table_of("date,x\n5/12/2023 10:00,1\n5/12/2023 10:01,2\n")),
              HasSubstr("dates are read as month/day/year"));
}

TEST(LogDialect, PlacesInMessagesAreThoseOfTheFile) {
  std::string text = "a,t,b,x\n";
  for (int i = 0; i < 30; ++i) text += "k," + std::to_string(i) + ",m,1\n";
  testing::expect_error<DataError>([&] { table_of(text + "k,30,m,wet\n"); }, "log.csv:32:4",
                                   "'wet' in column 'x'", "");
  testing::expect_error<DataError>([&] { table_of(text + "k,30,m\n"); }, "log.csv:32:2", "1 field",
                                   "");
}

}  // namespace
}  // namespace lacuna
