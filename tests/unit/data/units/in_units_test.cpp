// SPDX-License-Identifier: MIT
#include "data/units/in_units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two samples of th [deg], T [degC] and an input u [mV].
Dataset records() {
  Dataset data;
  data.states = {{"th", "deg"}, {"T", "degC"}};
  data.inputs = {{"u", "mV"}};
  Trajectory record;
  record.source = "run.csv";
  record.time = Eigen::Vector2d(0.0, 1.0);
  record.states = (Matrix(2, 2) << 180.0, 20.0, 90.0, 30.0).finished();
  record.inputs = Eigen::Vector2d(1500.0, -500.0);
  record.derivatives = (Matrix(2, 2) << 18.0, 1.0, 9.0, 2.0).finished();
  data.trajectories = {record};
  return data;
}

TEST(InUnits, ValuesAndRatesAreConverted) {
  const Dataset data = in_units_of({{"th", "rad"}, {"T", "K"}, {"u", "V"}}, records());
  const Trajectory& record = data.trajectories[0];
  EXPECT_NEAR(record.states(0, 0), 3.14159265358979, 1e-13);
  EXPECT_NEAR(record.states(1, 1), 303.15, 1e-12);
  EXPECT_NEAR(record.derivatives(0, 0), 0.314159265358979, 1e-14);
  EXPECT_EQ(record.derivatives(1, 1), 2.0) << "a rate has no offset";
  EXPECT_EQ(record.inputs(0, 0), 1.5);
  EXPECT_EQ(data.states[0].unit, "rad");
  EXPECT_EQ(data.inputs[0].unit, "V");
  ASSERT_EQ(data.notes.size(), 3u);
  EXPECT_EQ(data.notes[2], "run.csv: u is taken from mV to V (factor 0.001)");
}

TEST(InUnits, NothingIsSaidWithoutUnits) {
  Dataset data = records();
  data.states[1].unit = "";
  const Dataset same = in_units_of({{"th", ""}, {"T", "K"}, {"x", "m"}, {"u", "mV"}}, data);
  EXPECT_TRUE(same.notes.empty());
  EXPECT_EQ(same.trajectories[0].states, data.trajectories[0].states);
  EXPECT_EQ(same.states[1].unit, "");
}

}  // namespace
}  // namespace lacuna
