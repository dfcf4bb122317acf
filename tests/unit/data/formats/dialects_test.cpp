// SPDX-License-Identifier: MIT
// Texts as instruments and programs write them; values, names and units by hand.
#include "data/formats/dialects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/formats/read_text.hpp"
#include "lacuna/data/records/roles.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> names_of(const Table& table) {
  std::vector<std::string> names;
  for (const Quantity& column : table.columns)
    names.push_back(column.name + (column.unit.empty() ? "" : " " + column.unit));
  return names;
}

Vector row(const Table& table, Index i) { return table.values.row(i).transpose(); }

TEST(Dialects, RigolCountsSamples) {
  const Table table = parse_text_table(
      "X,CH1,CH2,Start,Increment,\r\nSequence,Volt,Volt,-5.0e-03,2.0e-03,\r\n"
      "0,1.20e-01,3,,\r\n1,1.30e-01,4,,\r\n2,1.40e-01,5,,\r\n",
      "r.csv");
  EXPECT_THAT(names_of(table), ElementsAre("t s", "CH1 V", "CH2 V"));
  ASSERT_EQ(table.values.rows(), 3);
  EXPECT_NEAR(table.values(2, 0), -1e-3, 1e-15);
  EXPECT_EQ(row(table, 1).tail(2), Eigen::Vector2d(0.13, 4.0));
  EXPECT_EQ(table.lines[0], 3u);
  EXPECT_THAT(table.notes.at(0), HasSubstr("Rigol"));
}

TEST(Dialects, SiglentNeedsNothingOfItsOwn) {
  const Table table = parse_text_table(
      "Record Length,Analog:3\nSample Interval,Analog:0.001\nVertical Scale,CH1:1,CH2:1\n"
      "Source,CH1,CH2\nSecond,Volt,Volt\n-0.001,0.1,1\n0,0.2,2\n0.001,0.3,3\n",
      "s.csv");
  EXPECT_THAT(names_of(table), ElementsAre("Source s", "CH1 V", "CH2 V"));
  EXPECT_EQ(row(table, 2), Eigen::Vector3d(0.001, 0.3, 3.0));
}

TEST(Dialects, TektronixHasItsPreambleBesideTheSamples) {
  const Table table = parse_text_table(
      "Record Length,2.5e+03,,-0.0005,  0.02,\nSource,CH2,,-0.0004,  0.04,\n"
      "Vertical Units,V,,-0.0003,  0.06,\nHorizontal Units,s,,-0.0002,0.08,\n"
      ",,,-0.0001,0.1,\n",
      "F0000CH2.CSV");
  EXPECT_THAT(names_of(table), ElementsAre("t s", "CH2 V"));
  ASSERT_EQ(table.values.rows(), 5);
  EXPECT_EQ(row(table, 4), Eigen::Vector2d(-0.0001, 0.1));
  EXPECT_EQ(table.lines[4], 5u);
}

TEST(Dialects, LabviewHasPacketsWithHeads) {
  const std::string head =
      "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nX_Columns\tOne\n"
      "***End_of_Header***\t\n\n";
  const std::string packet =
      "Channels\t2\nSamples\t2\t2\nY_Unit_Label\tVolts\tmA\nX0\t0.0\t0.0\nDelta_X\t0.5\t0.5\n"
      "***End_of_Header***\t\t\nX_Value\tdrive\tcurrent\tComment\n";
  const Table table = parse_text_table(
      head + packet + "0.0\t1\t10\n0.5\t2\t20\n\n" + packet + "1.0\t3\t30\n1.5\t4\t40\n",
      "m.lvm");
  EXPECT_THAT(names_of(table), ElementsAre("t s", "drive V", "current mA", "packet"));
  ASSERT_EQ(table.values.rows(), 4);
  EXPECT_EQ(row(table, 3), Eigen::Vector4d(1.5, 4.0, 40.0, 2.0));
  EXPECT_EQ(assign_roles(table, {}).trajectories.size(), 2u);
}

TEST(Dialects, LabviewWithoutTimesCountsSamples) {
  const Table table = parse_text_table(
      "LabVIEW Measurement\t\nSeparator\tTab\nX_Columns\tNo\n***End_of_Header***\t\n"
      "Channels\t1\nX0\t2.0\nDelta_X\t0.25\n***End_of_Header***\t\nX_Value\tv\tComment\n"
      "\t1,5\n\t2,5\n\t3,5\n",
      "m.lvm");
  EXPECT_EQ(row(table, 2), Eigen::Vector3d(2.5, 3.5, 1.0));
}

TEST(Dialects, LtspiceNamesAreNames) {
  const Table table = parse_text_table("time\tV(th)\tI(L1)\n0\t1\t2\n0.1\t3\t4\n", "a.txt");
  EXPECT_THAT(names_of(table), ElementsAre("time", "V_th", "I_L1"));
}

TEST(Dialects, LtspiceStepsAreRecords) {
  const Table table = parse_text_table(
      "time\tV(a)\nStep Information: R=1 (Step: 1/2)\n0\t1\n1e-3\t2\n2e-3\t2.5\n"
      "Step Information: R=2 (Step: 2/2)\n0\t3\n1e-3\t4\n2e-3\t5\n",
      "b.txt");
  EXPECT_THAT(names_of(table), ElementsAre("time", "V_a", "run"));
  const Dataset data = assign_roles(table, {});
  ASSERT_EQ(data.trajectories.size(), 2u);
  EXPECT_EQ(data.states.size(), 1u) << "the step is no state";
  EXPECT_EQ(data.trajectories[1].states(1, 0), 4.0);
}

TEST(Dialects, NgspiceListingsHavePages) {
  const std::string head =
      "Index   time            v(th)           \n" + std::string(60, '-') + "\n";
  const Table table = parse_text_table("\n  * a circuit\n  Transient Analysis\n" + head +
                                           "0\t0.0\t1.0\t\n1\t0.1\t2.0\t\n\f\n  * a circuit\n" +
                                           head + "2\t0.2\t3.0\t\n",
                                       "out.txt");
  EXPECT_THAT(names_of(table), ElementsAre("time", "v_th"));
  ASSERT_EQ(table.values.rows(), 3);
  EXPECT_EQ(row(table, 2), Eigen::Vector2d(0.2, 3.0));
}

TEST(Dialects, NgspiceDataRepeatTheTime) {
  const Table named = parse_text_table(
      " time            v(a)            time            i(b) \n 0.0 1.0 0.0 5.0 \n"
      " 0.1 2.0 0.1 6.0 \n 0.2 3.0 0.2 7.0\n",
      "w.data");
  EXPECT_THAT(names_of(named), ElementsAre("time", "v_a", "i_b"));
  EXPECT_EQ(row(named, 1), Eigen::Vector3d(0.1, 2.0, 6.0));
  const Table bare = parse_text_table(" 0.5 1.0 0.5 5.0\n 0.6 2.0 0.6 6.0\n", "w.data");
  EXPECT_THAT(names_of(bare), ElementsAre("t", "c2", "c4"));
  EXPECT_EQ(row(bare, 0), Eigen::Vector3d(0.5, 1.0, 5.0));
  EXPECT_EQ(bare.lines[0], 1u);
}

TEST(Dialects, RawFilesAreListsOfPoints) {
  const Table table = parse_text_table(
      "Title: * rc\nDate: today\nPlotname: Transient Analysis\nFlags: real\n"
      "No. Variables: 2\nNo. Points: 2\nVariables:\n\t0\ttime\ttime\n\t1\tv(out)\tvoltage\n"
      "Values:\n 0\t0.0\n\t1.5\n\n 1\t0.1\n\t2.5\n",
      "rc.raw");
  EXPECT_THAT(names_of(table), ElementsAre("time", "v_out"));
  EXPECT_EQ(row(table, 1), Eigen::Vector2d(0.1, 2.5));
  EXPECT_THAT(table.lines, ElementsAre(12, 15));
}

}  // namespace
}  // namespace lacuna
