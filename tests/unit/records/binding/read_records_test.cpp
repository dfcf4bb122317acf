// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/read_records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/derivatives/finite_differences.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/records/marks.hpp"
#include "support/diagnosis_scope.hpp"
#include "support/expect_error.hpp"
#include "support/harmonic_model.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using testing::expect_error;
using testing::TemporaryFolder;

const FiniteDifferences kDefaultDifferences;

/// x = cos(2 t) and u = t with a column that no model knows; `header` names t, x, u, spare.
std::string table_of(const std::string& header, double seconds = 1.0) {
  std::string text = header + "\n";
  for (int i = 0; i < 50; ++i) {
    const double t = 0.02 * i;
    text += std::to_string(t / seconds) + "," + std::to_string(std::cos(2.0 * t)) + "," +
            std::to_string(t) + ",7\n";
  }
  return text;
}

Dataset read(const std::vector<std::string>& paths) {
  return read_records(support::harmonic_model(), paths, {}, kDefaultDifferences);
}

TEST(ReadConditions, NeedTimesAndInputsAndTakeTheStatesThatAreThere) {
  const TemporaryFolder folder;
  const OdeModel model = support::harmonic_model().with_outputs(
      {{"y", "", parse_expression("x+v")}});
  const Dataset data =
      read_conditions(model, {folder.write("a.csv", "u,t,v\n3,0,7\n4,1,\n5,4,\n")}, {});
  ASSERT_EQ(data.trajectories.size(), 1u);
  const Trajectory& run = data.trajectories[0];
  EXPECT_EQ(run.time, (Vector{{0.0, 1.0, 4.0}}));
  EXPECT_EQ(run.inputs.col(0), (Vector{{3.0, 4.0, 5.0}}));
  EXPECT_EQ(run.states(0, 1), 7.0);
  EXPECT_EQ(mark_of(run.marks, 0, 1), Mark::Value);
  EXPECT_EQ(mark_of(run.marks, 1, 1), Mark::Missing);
  EXPECT_TRUE(is_hidden(data, 0)) << "x is not made from v";
  const Dataset none = read_conditions(model, {folder.write("b.csv", "t,u\n0,1\n1,2\n")}, {});
  EXPECT_TRUE(is_hidden(none, 0) && is_hidden(none, 1));
  EXPECT_THROW(read_conditions(model, {folder.write("c.csv", "t,x\n0,1\n1,2\n")}, {}), DataError);
}

TEST(ReadRecords, WhatIsHiddenInOneFileOnlyIsMeasured) {
  const TemporaryFolder folder;
  folder.write("a1.csv", table_of("t,v,u,x"));
  folder.write("a2.csv", table_of("t,v,u,spare"));
  const Dataset data = read({folder.file("a*.csv")});
  EXPECT_THAT(data.reconstructed, ElementsAre(false, false));
  EXPECT_FALSE(is_hidden(data, 0));
  EXPECT_EQ(data.trajectories[0].states(3, 0), 7.0);
  EXPECT_EQ(mark_of(data.trajectories[1].marks, 3, 0), Mark::Missing);
}

TEST(ReadRecords, OutputsAreColumnsOfTheirOwn) {
  const TemporaryFolder folder;
  const OdeModel model = support::harmonic_model().with_outputs(
      {{"p", "m", parse_expression("x")}, {"e", "J", parse_expression("v^2")}});
  const std::string path = folder.write("a.csv", table_of("t,p,u,e"));
  const Dataset data = read_records(model, {path}, {}, kDefaultDifferences, Columns::All);
  ASSERT_EQ(data.state_count(), 3);
  EXPECT_EQ(data.input_count(), 1) << "outputs are not unused columns";
  EXPECT_EQ(data.trajectories[0].states(5, 2), 7.0);
  EXPECT_NEAR(data.trajectories[0].states(5, 0), std::cos(0.2), 1e-6);
  EXPECT_THAT(data.reconstructed, ElementsAre(false, true, false));
}

TEST(ReadRecords, BlanksOfFurtherColumnsAreZeroWhereBlanksAreKept) {
  const TemporaryFolder folder;
  std::string text = "t,x,u,sd,empty\n";
  for (int i = 0; i < 30; ++i)
    text += std::to_string(i) + (i % 3 == 0 ? ",,1,," : ",2.5,1,0.25,") + "\n";
  const std::string path = folder.write("a.csv", text);
  ColumnRoles roles;
  roles.blanks = Blanks::Keep;
  const Dataset data =
      read_records(support::harmonic_model(), {path}, roles, kDefaultDifferences, Columns::All);
  ASSERT_EQ(data.input_count(), 2);
  EXPECT_EQ(data.inputs[1].name, "sd");
  EXPECT_EQ(data.trajectories[0].inputs(3, 1), 0.0);
  EXPECT_EQ(data.trajectories[0].inputs(4, 1), 0.25);
}

TEST(ReadRecords, BringsTimeToTheUnitOfTheModel) {
  const TemporaryFolder folder;
  const Dataset seconds = read({folder.write("s.csv", table_of("t [s],x,u,spare"))});
  const Dataset other = read({folder.write("ms.csv", table_of("t [ms],x,u,spare", 1e-3))});
  EXPECT_EQ(other.time_unit, "s");
  EXPECT_LT((other.trajectories[0].time - seconds.trajectories[0].time).norm(), 1e-12);
  EXPECT_LT((other.trajectories[0].states - seconds.trajectories[0].states).norm(), 1e-9);
  const std::string turns = folder.write("turns.csv", table_of("t [rev],x,u,spare"));
  expect_error<DataError>([&] { read({turns}); }, turns, "time is in rev", "same unit");
}

TEST(ReadRecords, ATimeWithoutUnitIsInThatOfTheModel) {
  const TemporaryFolder folder;
  const OdeModel s = support::harmonic_model();
  const OdeModel ms(s.states(), s.inputs(), s.equations(), "ms");
  const std::string path = folder.write("a.csv", table_of("t,x,u,spare [s]"));
  const Dataset data = read_records(ms, {path}, {}, kDefaultDifferences);
  EXPECT_EQ(data.time_unit, "ms");
  EXPECT_NEAR(data.trajectories[0].duration(), 0.98, 1e-9);
}

TEST(ReadRecords, FilesMayDifferInTheirColumns) {
  const TemporaryFolder folder;
  folder.write("a1.csv", table_of("t,x,u,v"));
  folder.write("a2.csv", table_of("t,x,u,spare"));
  const Dataset data = read({folder.file("a*.csv")});
  ASSERT_EQ(data.trajectories.size(), 2u);
  EXPECT_EQ(data.trajectories[0].states.col(1), Vector::Constant(50, 7.0));
  EXPECT_NE(data.trajectories[1].states(20, 1), 7.0);
  EXPECT_THAT(data.reconstructed, ElementsAre(false, true)) << "one file does not have it";
  const std::string none = folder.file("no*.csv");
  expect_error<DataError>([&] { read({none}); }, none, "no file matches", "names");
}

TEST(UnusedPart, IsWhatFollowsTheInputsOfTheModel) {
  Dataset data = support::oscillator_record();
  Trajectory& record = data.trajectories[0];
  data.inputs.push_back({"G", "N"});
  record.inputs.conservativeResize(record.samples(), 2);
  record.inputs.col(1) = 3.0 * record.time;
  const Dataset used = used_part(support::oscillator(), data);
  const Dataset unused = unused_part(support::oscillator(), data);
  EXPECT_EQ(used.inputs, support::oscillator().inputs());
  EXPECT_EQ(used.trajectories[0].inputs, record.inputs.leftCols(1));
  ASSERT_EQ(unused.inputs.size(), 1u);
  EXPECT_EQ(unused.inputs[0].name, "G");
  EXPECT_EQ(unused.trajectories[0].inputs, 3.0 * record.time);
}

TEST(ReadInputs, NeedsNoStates) {
  const TemporaryFolder folder;
  const std::string path = folder.write("u.csv", table_of("t [ms],spare,u,x", 1e-3));
  const Dataset data = read_inputs(support::harmonic_model(), path, {});
  const Trajectory& record = data.trajectories.at(0);
  ASSERT_EQ(record.inputs.cols(), 1);
  EXPECT_EQ(record.states.cols(), 0);
  EXPECT_LT((record.inputs.col(0) - record.time).cwiseAbs().maxCoeff(), 1e-12)
      << "u = t in seconds";
}

TEST(ReadRecords, KeepsColumnsThatTheModelDoesNotKnow) {
  const TemporaryFolder folder;
  folder.write("b1.csv", table_of("t,x,u,spare"));
  folder.write("b2.csv", "spare,u,x,other,t\n" + std::string(R"(1,0.0,1.0,5,0.0
2,0.1,0.9,,0.1
3,0.2,0.8,5,0.2
4,0.3,0.7,5,0.3
5,0.4,0.6,5,0.4
6,0.5,0.5,5,0.5
)"));
  const Dataset data = read_records(support::harmonic_model(), {folder.file("b*.csv")}, {},
                                    kDefaultDifferences, Columns::All);
  ASSERT_EQ(data.inputs.size(), 2u) << "not 'other', which one file lacks and misses a value";
  EXPECT_EQ(data.inputs[1].name, "spare");
  ASSERT_EQ(data.trajectories.size(), 2u) << "the missing value splits nothing";
  EXPECT_EQ(data.trajectories[0].inputs(9, 1), 7.0);
  EXPECT_EQ(data.trajectories[1].inputs.col(1), Vector::LinSpaced(6, 1.0, 6.0));
}

TEST(ReadRecords, TakesTheUnitOfTheTimeThatIsGiven) {
  const TemporaryFolder folder;
  const Dataset data = read_records(support::harmonic_model(),
                                    {folder.write("a.csv", table_of("t [s],x,u,spare"))},
                                    {.time_unit = "ms"}, kDefaultDifferences);
  EXPECT_NEAR(data.trajectories[0].duration(), 0.98e-3, 1e-9) << "the header is wrong";
}

TEST(RecordsOfTables, AreThoseOfFilesWithTheSameColumns) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.csv", table_of("t [s],Weg,u [N],spare"));
  const ColumnRoles roles{.names = {{"x", "Weg"}}};
  const OdeModel model = support::harmonic_model();
  const Dataset file = read_records(model, {path}, roles, kDefaultDifferences, Columns::All);
  const Dataset table =
      records_of_tables(model, {read_table(path)}, roles, kDefaultDifferences, Columns::All);
  EXPECT_EQ(table.states, file.states);
  EXPECT_EQ(table.inputs, file.inputs);
  EXPECT_EQ(table.trajectories.at(0).states, file.trajectories.at(0).states);
  EXPECT_EQ(inputs_of_table(model, read_table(path), {}).trajectories.at(0).inputs,
            read_inputs(model, path, {}).trajectories.at(0).inputs);
  expect_error<DataError>([&] { records_of_tables(model, {}, {}, kDefaultDifferences); },
                          "data", "no record", "at least one");
}

}  // namespace
}  // namespace lacuna
