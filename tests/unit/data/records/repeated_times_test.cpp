// SPDX-License-Identifier: MIT
#include "data/records/repeated_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

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
  testing::expect_error<DataError>(
      [] { assign_roles(table_with_repeats(40, {20}), {}); }, "a.csv:22:1", "stands still", "");
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
