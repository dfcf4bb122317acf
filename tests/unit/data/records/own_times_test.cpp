// SPDX-License-Identifier: MIT
#include "data/records/own_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
