// SPDX-License-Identifier: MIT
#include "data/records/blanks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lacuna/data/records/marks.hpp"
#include "lacuna/data/records/roles.hpp"

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

}  // namespace
}  // namespace lacuna
