// SPDX-License-Identifier: MIT
#include "data/records/far_variables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lacuna {
namespace {

/// A sine and a cosine, shifted by so much, and an input that is the cosine.
Dataset shifted(double x, double u, double size = 1.0) {
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  data.inputs = {{"u", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(400, 0.0, 50.0);
  record.states.resize(400, 2);
  record.states.col(0) = x + size * record.time.array().sin();
  record.states.col(1) = record.time.array().cos();
  record.inputs = (u + record.time.array().cos()).matrix();
  data.trajectories = {record, record};
  return data;
}

TEST(FarVariables, AreThoseThatMoveLittleBesideWhereTheyAre) {
  EXPECT_TRUE(far_variables(shifted(0.0, 0.0)).empty());
  EXPECT_TRUE(far_variables(shifted(12.0, -13.0)).empty());
  const auto far = far_variables(shifted(16.0, -3e5));
  ASSERT_EQ(far.size(), 2u);
  EXPECT_EQ(far[0].name, "x");
  EXPECT_NEAR(far[0].deviations, 16.0 * std::sqrt(2.0), 1.0);
  EXPECT_EQ(far[1].name, "u");
}

TEST(FarVariables, CentresHaveAsManyDigitsAsTheMotionAllows) {
  for (const double x : {1234.56789, -1234.56789, 98765432.1, 7.0e11}) {
    const auto far = far_variables(shifted(x, 0.0));
    ASSERT_EQ(far.size(), 1u) << x;
    EXPECT_NEAR(far[0].centre, x, 0.1) << "tenths of a motion of 0.7";
    EXPECT_EQ(far[0].centre, std::round(10.0 * far[0].centre) / 10.0) << x;
  }
  const auto small = far_variables(shifted(0.125, 0.0, 1e-7));
  ASSERT_EQ(small.size(), 1u);
  EXPECT_EQ(small[0].centre, 0.125);
}

TEST(FarVariables, OfWhatDoesNotMoveOrHasNoValueNothingIsSaid) {
  Dataset data = shifted(500.0, 0.0);
  data.trajectories[0].states(3, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(far_variables(data).size(), 1u);
  for (Trajectory& record : data.trajectories) record.states.col(0).setConstant(500.0);
  EXPECT_TRUE(far_variables(data).empty());
  for (Trajectory& record : data.trajectories)
    record.states.col(0).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(far_variables(data).empty());
  EXPECT_TRUE(far_variables(shifted(1e300, 0.0, 1e299)).empty());
  for (Trajectory& record : data.trajectories) record.states.resize(record.samples(), 0);
  EXPECT_TRUE(far_variables(data).empty()) << "columns that are not there";
}

}  // namespace
}  // namespace lacuna
