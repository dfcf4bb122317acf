// SPDX-License-Identifier: MIT
#include "lacuna/data/records/roles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "data/formats/read_text.hpp"
#include "data/records/same_columns.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using testing::expect_error;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Table table_of(const std::string& header) {
  std::string rows;
  const auto columns = 1 + std::count(header.begin(), header.end(), ',');
  for (int row = 0; row < 3; ++row)
    for (long column = 0; column < columns; ++column)
      rows += std::to_string(10 * column + row) + (column + 1 < columns ? "," : "\n");
  return parse_text_table(header + "\n" + rows, "a.csv");
}

TEST(FindColumns, TimeIsFoundByNameOrComesFirst) {
  EXPECT_EQ(find_columns(table_of("x,t,time"), {}).time, Index{1});
  EXPECT_EQ(find_columns(table_of("x,T,Time"), {}).time, Index{2});
  EXPECT_EQ(find_columns(table_of("x,T"), {}).time, Index{1});
  const ColumnIndices by_place = find_columns(table_of("x,y"), {});
  EXPECT_EQ(by_place.time, Index{0});
  EXPECT_TRUE(by_place.time_by_position);
}

TEST(FindColumns, TheFirstFreeColumnIsTheTimeWhenOthersHaveRoles) {
  const ColumnIndices columns =
      find_columns(table_of("run,clock,x"), {.states = {"x"}, .trajectory = "run"});
  EXPECT_EQ(columns.time, Index{1});
}

TEST(FindColumns, EveryOtherColumnIsAState) {
  const ColumnIndices columns = find_columns(
      table_of("t,x,u,dx,run"), {.inputs = {"u"}, .derivatives = {"dx"}, .trajectory = "run"});
  EXPECT_THAT(columns.states, ElementsAre(1));
  EXPECT_THAT(columns.used(), ElementsAre(0, 1, 2, 3, 4));
}

TEST(FindColumns, HeaderTextsNameColumnsToo) {
  EXPECT_THAT(
      find_columns(table_of("t,Ch 1 (V),Ch 2 (V)"), {.states = {"Ch 2", "Ch_1"}}).states,
      ElementsAre(2, 1));
}

TEST(FindColumns, AStepReplacesTheTime) {
  const ColumnIndices columns = find_columns(table_of("t,x"), {.step = 0.1});
  EXPECT_FALSE(columns.time);
  EXPECT_THAT(columns.states, ElementsAre(1));
  EXPECT_THAT(columns.notes, ElementsAre(HasSubstr("column 't' is not used")));
}

void expect_refused(const std::string& header, const ColumnRoles& roles,
                    const std::string& problem, const std::string& remedy) {
  expect_error<DataError>([&] { find_columns(table_of(header), roles); }, "a.csv", problem,
                          remedy);
}

TEST(FindColumns, RefusesUnknownNames) {
  expect_refused("t,speed", {.states = {"sped"}}, "no column 'sped'", "did you mean 'speed'?");
  expect_refused("t,x", {.time = "clock"}, "no column 'clock'", "known are: t, x");
  expect_refused("t,x", {.trajectory = "run"}, "no column 'run'", "known are");
}

TEST(FindColumns, RefusesRolesThatDoNotFit) {
  expect_refused("t,x,y", {.states = {"x"}, .inputs = {"x"}}, "'x' is named twice", "one role");
  expect_refused("t,x,y", {.states = {"x", "x"}}, "'x' is named twice", "one role");
  expect_refused("t,x,y,dx", {.derivatives = {"dx"}}, "1 derivatives are given for 2 states",
                 "same order");
  expect_refused("x", {}, "no column for a state", "sampling step");
  expect_refused("x", {.states = {"x"}}, "none is left for the time", "sampling step");
}

TEST(FindColumns, RefusesStepsThatAreNone) {
  const Table table = table_of("t,x");
  for (const double step : {0.0, -1.0, std::nan("")})
    expect_error<ConfigError>([&] { find_columns(table, {.step = step}); }, "sampling step",
                              "is not a step", "greater than 0");
  expect_error<ConfigError>([&] { find_columns(table, {.time = "t", .step = 1.0}); },
                            "sampling step", "both", "leave one");
}

TEST(AssignRoles, FillsTheDataset) {
  const Table table =
      parse_text_table("time [ms],x [V],u [A],dx [V/ms]\n0,1,2,3\n1,4,5,6\n2,7,8,9\n", "a.csv");
  const Dataset data = assign_roles(table, {.inputs = {"u"}, .derivatives = {"dx"}});
  EXPECT_EQ(data.time_unit, "ms");
  EXPECT_EQ(data.states, (std::vector<Quantity>{{"x", "V"}}));
  EXPECT_EQ(data.inputs, (std::vector<Quantity>{{"u", "A"}}));
  ASSERT_EQ(data.trajectories.size(), 1u);
  const Trajectory& record = data.trajectories[0];
  EXPECT_EQ(record.source, "a.csv");
  EXPECT_EQ(record.time, Vector::LinSpaced(3, 0.0, 2.0));
  EXPECT_EQ(record.states.col(0), (Vector(3) << 1, 4, 7).finished());
  EXPECT_EQ(record.inputs.col(0), (Vector(3) << 2, 5, 8).finished());
  EXPECT_EQ(record.derivatives.col(0), (Vector(3) << 3, 6, 9).finished());
  EXPECT_THAT(data.notes, IsEmpty());
  EXPECT_NO_THROW(check_dataset(data));
}

TEST(AssignRoles, AStepMakesTheTimeAndGapsKeepTheirLength) {
  const Table table = parse_text_table("x\n1\n2\nnan\n4\n5\n", "a.csv");
  const Dataset data = assign_roles(table, {.step = 0.5});
  ASSERT_EQ(data.trajectories.size(), 2u);
  EXPECT_EQ(data.time_unit, "s");
  EXPECT_EQ(data.trajectories[0].time, (Vector(2) << 0.0, 0.5).finished());
  EXPECT_EQ(data.trajectories[1].time, (Vector(2) << 1.5, 2.0).finished());
}

TEST(AssignRoles, AStepStartsAgainInEveryNumberedRecord) {
  const Table table = parse_text_table("run,x\n1,1\n1,2\n1,3\n2,4\n2,5\n", "a.csv");
  const Dataset data = assign_roles(table, {.step = 1.0, .trajectory = "run"});
  ASSERT_EQ(data.trajectories.size(), 2u);
  EXPECT_EQ(data.trajectories[1].time, (Vector(2) << 0.0, 1.0).finished());
  EXPECT_EQ(data.trajectories[1].source, "a.csv, record 2");
}

TEST(AssignRoles, PiecesOfARecordAreToldFromRecords) {
  const auto sources = [](const std::string& text, const ColumnRoles& roles) {
    std::vector<std::string> names;
    for (const Trajectory& record :
         assign_roles(parse_text_table(text, "a.csv"), roles).trajectories)
      names.push_back(record.source);
    return names;
  };
  const std::string text = "t,run,x\n0,7,1\n1,7,2\n2,5,2\n3,5,1\n4,5,\n5,5,4\n6,5,4\n";
  EXPECT_THAT(sources(text, {.trajectory = "run"}),
              ElementsAre("a.csv, record 1", "a.csv, record 2, piece 1",
                          "a.csv, record 2, piece 2"));
  EXPECT_THAT(sources("t,x\n0,1\n1,2\n2,\n3,4\n4,4\n", {}),
              ElementsAre("a.csv, piece 1", "a.csv, piece 2"));
  EXPECT_THAT(sources("t,run,x\n0,7,1\n1,7,2\n", {.trajectory = "run"}),
              ElementsAre("a.csv"));
}

TEST(AssignRoles, AStateCalledTGetsAnotherName) {
  const Dataset data = assign_roles(table_of("time,t,x"), {.time = "time"});
  EXPECT_THAT(names_of(data.states), ElementsAre("t_", "x"));
  EXPECT_THAT(data.notes, Contains(HasSubstr("'t' is called 't_'")));
}

TEST(AssignRoles, TheNameOfTheTimeMaySayItsUnit) {
  for (const auto& [header, unit] :
       std::vector<std::pair<std::string, std::string>>{{"time_ms", "ms"},
                                                        {"Time in ms", "ms"},
                                                        {"millis", "ms"},
                                                        {"t (us)", "us"},
                                                        {"timestamp_ns", "ns"},
                                                        {"Time [msec]", "ms"},
                                                        {"time_s", "s"},
                                                        {"t", "s"}}) {
    const Table table = parse_text_table(header + ",x\n0,1\n1,2\n", "a.csv");
    EXPECT_EQ(assign_roles(table, {}).time_unit, unit) << header;
  }
  const Table table = parse_text_table("time_ms,x\n0,1\n1,2\n", "a.csv");
  EXPECT_THAT(assign_roles(table, {}).notes,
              ElementsAre("a.csv: the time is in ms, as the name of column 'time_ms' says"));
  EXPECT_EQ(assign_roles(table, {.time_unit = "us"}).time_unit, "us");
  EXPECT_THAT(assign_roles(table, {.time_unit = "us"}).notes, IsEmpty());
}

TEST(AssignRoles, AUnitThatIsNotCertainIsSaid) {
  const auto notes = [](const std::string& header) {
    const Dataset data = assign_roles(parse_text_table(header + ",x\n0,1\n1,2\n", "a.csv"), {});
    EXPECT_EQ(data.time_unit, "s");
    return data.notes;
  };
  EXPECT_THAT(notes("t_min"), ElementsAre(HasSubstr("give --time-unit min if that is meant")));
  EXPECT_THAT(notes("frame"), ElementsAre(HasSubstr("give their step with --dt")));
  EXPECT_THAT(notes("time_ms [s]"), ElementsAre(HasSubstr("not in ms as its name says")));
  EXPECT_THAT(notes("t"), IsEmpty());
  EXPECT_THAT(notes("s"), IsEmpty());
}

TEST(FindColumns, TimeWithAUnitIsTheTimeWhereverItStands) {
  EXPECT_EQ(find_columns(table_of("x,time_ms,y"), {}).time, 1);
  EXPECT_EQ(find_columns(table_of("x,time_constant_ms,y"), {}).time, 0);
  EXPECT_EQ(find_columns(table_of("time_ms,t,x"), {}).time, 1) << "t goes before it";
}

Table table_with(const std::string& header, const std::string& source) {
  return parse_text_table(header + "\n0,1,2\n1,2,3\n", source);
}

TEST(NameInOrder, ColumnsWithoutNamesGetThoseOfTheRoles) {
  Table with_time = parse_text_table("0,1,2\n1,2,3\n", "a");
  name_in_order(with_time, {.states = {"x"}, .inputs = {"u"}});
  EXPECT_EQ(with_time.columns[0].name, "t");
  EXPECT_EQ(with_time.columns[1].name, "x");
  EXPECT_EQ(with_time.columns[2].name, "u");
  ASSERT_EQ(with_time.notes.size(), 1u);
  EXPECT_THAT(with_time.notes[0], ::testing::HasSubstr("are called t, x, u, in this order"));
  Table with_step = parse_text_table("0,1,2\n1,2,3\n", "a");
  name_in_order(with_step, {.step = 0.1, .states = {"x", "y", "z"}});
  EXPECT_EQ(with_step.columns[0].name, "x");
  EXPECT_EQ(with_step.columns[2].name, "z");
}

TEST(NameInOrder, OthersKeepTheirs) {
  for (const ColumnRoles& roles :
       {ColumnRoles{.states = {"x"}}, ColumnRoles{.states = {"c2", "y"}},
        ColumnRoles{.step = 0.1, .states = {"x", "y"}}, ColumnRoles{.states = {"x", "sin"}},
        ColumnRoles{.states = {"x", "x"}}}) {
    Table table = parse_text_table("0,1,2\n1,2,3\n", "a");
    name_in_order(table, roles);
    EXPECT_EQ(table.columns[1].name, "c2");
  }
  Table named = table_with("t,x,y", "a");
  name_in_order(named, {.states = {"a", "b"}});
  EXPECT_EQ(named.columns[1].name, "x");
}

}  // namespace
}  // namespace lacuna
