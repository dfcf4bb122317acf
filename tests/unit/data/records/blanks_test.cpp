// SPDX-License-Identifier: MIT
#include "data/records/blanks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "data/records/own_times.hpp"
#include "data/records/repeated_times.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/data/records/roles.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

constexpr double kBlank = std::numeric_limits<double>::quiet_NaN();

Table with_blanks() {
  Table table;
  table.source = "run.csv";
  table.columns = {{"t", ""}, {"x", ""}, {"u", ""}};
  table.values =
      Matrix{{0.0, kBlank, 1.0}, {1.0, 2.0, 1.0},    {2.0, kBlank, 1.0}, {3.0, kBlank, 1.0},
             {4.0, 8.0, kBlank}, {5.0, kBlank, 1.0}, {6.0, 7.0, 1.0}};
  table.headers = {"t", "x", "u"};
  return table;
}

TEST(AssignRoles, KeptBlanksAndJumpsBeginNoRecord) {
  Table table;
  table.source = "uneven.csv";
  table.columns = {{"t", "s"}, {"x", ""}};
  table.values = Matrix(12, 2);
  for (Index i = 0; i < 12; ++i)
    table.values.row(i) << (i < 2 ? 0.0 : 5.0) + 0.1 * static_cast<double>(i), 1.0;
  table.values(0, 1) = kBlank;
  for (Index i = 0; i < 12; ++i) table.lines.push_back(static_cast<std::size_t>(i) + 2);
  ColumnRoles roles;
  roles.blanks = Blanks::Mark;
  EXPECT_EQ(assign_roles(table, roles).trajectories.size(), 2u) << "a gap";
  roles.blanks = Blanks::Keep;
  const Dataset kept = assign_roles(table, roles);
  ASSERT_EQ(kept.trajectories.size(), 1u);
  EXPECT_EQ(kept.trajectories[0].samples(), 12);
  EXPECT_EQ(kept.trajectories[0].marks(0, 0), number_of(Mark::Missing));
}

TEST(AssignRoles, ChannelsWithRatesOfTheirOwnKeepTheRowsThatAllHave) {
  Table table;
  table.source = "rates.csv";
  table.columns = {{"t", "s"}, {"x", ""}, {"y", ""}};
  table.values.resize(50, 3);
  for (Index i = 0; i < 50; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    table.values.row(i) << t, 2.0 * t, i % 5 == 0 ? 3.0 * t : kBlank;
    table.lines.push_back(static_cast<std::size_t>(i) + 2);
  }
  const Dataset data = assign_roles(table, {});
  ASSERT_EQ(data.trajectories.size(), 1u);
  EXPECT_EQ(data.trajectories[0].samples(), 10);
  EXPECT_DOUBLE_EQ(data.trajectories[0].states(3, 1), 4.5);
  EXPECT_EQ(common_rows(table, {0, 2})->lines[2], 12u);
  EXPECT_FALSE(common_rows(table, {0, 1})) << "nothing is blank there";
}

TEST(AssignRoles, AStateThatIsBlankIsMarkedAndAnInputCuts) {
  ColumnRoles roles;
  roles.inputs = {"u"};
  roles.blanks = Blanks::Mark;
  const Dataset data = assign_roles(with_blanks(), roles);
  ASSERT_EQ(data.trajectories.size(), 2u) << "row 4 has no input";
  EXPECT_EQ(data.trajectories[0].states, Eigen::Vector4d(2.0, 2.0, 4.0, 6.0))
      << "straight from value to value";
  EXPECT_EQ(mark_of(data.trajectories[0].marks, 3, 0), Mark::Missing);
  EXPECT_EQ(mark_of(data.trajectories[1].marks, 0, 0), Mark::Missing);
  EXPECT_EQ(mark_of(data.trajectories[1].marks, 1, 0), Mark::Value);
}

/// x at 0, 0.1, ..., y in between: no row has both.
Table with_two_clocks(Index samples) {
  Table table;
  table.source = "scope.csv";
  table.columns = {{"t", "s"}, {"x", ""}, {"y", ""}};
  table.headers = {"t", "x", "y"};
  table.values = Matrix::Constant(2 * samples, 3, kBlank);
  for (Index i = 0; i < 2 * samples; ++i) {
    const double t = 0.05 * static_cast<double>(i);
    table.values(i, 0) = t;
    table.values(i, 1 + i % 2) = i % 2 == 0 ? std::cos(t) : t * t * t;
  }
  return table;
}

TEST(RowsOfDensest, OtherChannelsAreInterpolatedAtItsTimes) {
  const Table table = with_two_clocks(40);
  const auto even = rows_of_densest(table, 0, {1, 2});
  ASSERT_TRUE(even);
  EXPECT_EQ(even->values.rows(), 39) << "the first one is in front of the other channel";
  EXPECT_DOUBLE_EQ(even->values(0, 0), 0.1);
  EXPECT_NEAR(even->values(20, 2), std::pow(even->values(20, 0), 3.0), 1e-12);
  EXPECT_NE(even->notes.back().find("the 39 times of 'x' are used"), std::string::npos);
  EXPECT_EQ(assign_roles(table, {}).trajectories.at(0).samples(), 39);
}

TEST(RowsOfDensest, FewValuesOrCompleteRowsAreLeftAlone) {
  EXPECT_FALSE(rows_of_densest(with_two_clocks(7), 0, {1, 2}));
  Table table = with_two_clocks(40);
  table.values.block(3, 1, 2, 2).setOnes();
  EXPECT_FALSE(rows_of_densest(table, 0, {1, 2})) << "two complete rows follow one another";
  table = with_two_clocks(40);
  table.values(9, 0) = 0.0;
  EXPECT_FALSE(rows_of_densest(table, 0, {1, 2})) << "the time goes backwards";
}

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

TEST(ChannelAt, GoesOnAsItsHoldSays) {
  const Vector time = Vector::LinSpaced(6, 0.0, 5.0), values = time.array().square();
  const Vector queries = Eigen::Vector4d(-0.5, 1.5, 5.5, 6.5);
  const Vector held = channel_at(time, values, Interpolation::Held, queries);
  EXPECT_TRUE(std::isnan(held[0]));
  EXPECT_EQ(held[1], 1.0);
  EXPECT_EQ(held[2], 25.0) << "a step behind the last sample";
  EXPECT_TRUE(std::isnan(held[3]));
  const Vector linear = channel_at(time, values, Interpolation::Linear, queries);
  EXPECT_EQ(linear[1], 2.5);
  EXPECT_TRUE(std::isnan(linear[2]));
  EXPECT_NEAR(channel_at(time, values, Interpolation::Quintic, queries)[1], 2.25, 1e-12);
}

TEST(ChannelAt, SaysNothingInGapsOfItsSampling) {
  Vector time = Vector::LinSpaced(8, 0.0, 7.0);
  time.tail(4).array() += 3.0;
  const Vector values = Vector::LinSpaced(8, 1.0, 8.0);
  const Vector found =
      channel_at(time, values, Interpolation::Linear, Eigen::Vector3d(3.0, 4.0, 7.0));
  EXPECT_EQ(found[0], 4.0);
  EXPECT_TRUE(std::isnan(found[1]));
  EXPECT_EQ(found[2], 5.0);
}

/// x each 2 s, u each 3 s from 0 on, y at the times of x but one.
Table log() {
  Table table;
  table.source = "a.csv+b.csv";
  table.columns = {{"t", "s"}, {"x", ""}, {"u", ""}};
  table.own_times = true;
  table.values = Matrix::Constant(25, 3, kMissing);
  for (Index i = 0; i < 25; ++i) {
    table.values(i, 0) = static_cast<double>(i);
    if (i % 2 == 0) table.values(i, 1) = std::sin(0.1 * static_cast<double>(i));
    if (i % 3 == 0) table.values(i, 2) = static_cast<double>(i * i);
  }
  return table;
}

TEST(AssignRoles, InputsGoOnBetweenTheirSamples) {
  ColumnRoles roles;
  roles.inputs = {"u"};
  roles.blanks = Blanks::Mark;
  roles.holds = {{"u", Hold::Zero}};
  const Dataset held = assign_roles(log(), roles);
  ASSERT_EQ(held.trajectories.size(), 1u);
  EXPECT_EQ(held.samples(), 25);
  EXPECT_EQ(held.trajectories[0].inputs(5, 0), 9.0);
  EXPECT_EQ(held.trajectories[0].marks.col(0).sum(), 12.0 * 2.0) << "as many x are missing";
  roles.holds.clear();
  const Dataset smooth = assign_roles(log(), roles);
  EXPECT_NEAR(smooth.trajectories[0].inputs(5, 0), 25.0, 1e-9);
}

TEST(AssignRoles, RecordsThatBlanksCutHaveTheTimesOfOneChannel) {
  Table table = log();
  table.columns.push_back({"y", ""});
  table.values.conservativeResize(Eigen::NoChange, 4);
  for (Index i = 0; i < 25; ++i)
    table.values(i, 3) = i % 3 == 0 ? static_cast<double>(i * i * i) : kMissing;
  const Dataset data = assign_roles(table, {.states = {"x", "y"}, .inputs = {"u"}});
  ASSERT_EQ(data.trajectories.size(), 1u);
  const Trajectory& record = data.trajectories[0];
  ASSERT_EQ(record.samples(), 13);
  EXPECT_EQ(record.time[1], 2.0);
  EXPECT_NEAR(record.states(5, 1), 1000.0, 1e-9) << "a cubic";
  EXPECT_NEAR(record.inputs(5, 0), 100.0, 1e-9);
  EXPECT_THAT(data.notes, ::testing::Contains(::testing::HasSubstr("the 13 times of 'x'")));
}

/// n rows of t = 0, 1, 2, ... and x = t^2 in which some have the time of the one before.
Table table_with_repeats(Index n, const std::vector<Index>& repeats) {
  Table table;
  table.source = "a.csv";
  table.columns = {{"t", ""}, {"x", ""}};
  table.values.resize(n, 2);
  for (Index i = 0; i < n; ++i) {
    table.values(i, 0) = static_cast<double>(i);
    table.values(i, 1) = static_cast<double>(i * i);
    table.lines.push_back(static_cast<std::size_t>(i) + 2);
  }
  for (const Index row : repeats) table.values(row, 0) = table.values(row - 1, 0);
  return table;
}

TEST(RepeatedTimes, ARowWithTheTimeOfTheOneBeforeIsLeftOut) {
  const Dataset data = assign_roles(table_with_repeats(100, {40, 70}), {});
  ASSERT_FALSE(data.notes.empty());
  EXPECT_THAT(data.notes[0],
              ::testing::HasSubstr("a.csv:42:1: 2 rows have the time of the row before"));
  Index samples = 0;
  for (const Trajectory& record : data.trajectories) {
    samples += record.samples();
    for (Index i = 0; i < record.samples(); ++i)
      EXPECT_EQ(record.states(i, 0), record.time[i] * record.time[i]);
  }
  EXPECT_EQ(samples, 98);
}

TEST(RepeatedTimes, ManyAreAnError) {
  testing::expect_error<DataError>([] { assign_roles(table_with_repeats(40, {20}), {}); },
                                   "a.csv:22:1", "stands still", "");
}

TEST(RepeatedTimes, TheFirstRowOfANewRecordIsNone) {
  Table table = table_with_repeats(100, {50});
  table.columns.push_back({"run", ""});
  table.values.conservativeResize(Eigen::NoChange, 3);
  table.values.col(2).head(50).setZero();
  table.values.col(2).tail(50).setOnes();
  ColumnRoles roles;
  roles.trajectory = "run";
  const ColumnIndices columns = find_columns(table, roles);
  EXPECT_FALSE(without_repeated_times(table, columns));
}

}  // namespace
}  // namespace lacuna
