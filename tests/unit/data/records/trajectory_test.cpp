// SPDX-License-Identifier: MIT
#include "lacuna/data/records/trajectory.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lacuna {
namespace {

Trajectory record_at(const std::vector<double>& times) {
  Trajectory trajectory;
  trajectory.time = Eigen::Map<const Vector>(times.data(), static_cast<Index>(times.size()));
  return trajectory;
}

TEST(UniformStep, IsTheMeanStep) {
  EXPECT_DOUBLE_EQ(*uniform_step(record_at({1.0, 1.5, 2.0, 2.5})), 0.5);
  EXPECT_DOUBLE_EQ(*uniform_step(record_at({0.0, 1.0005, 2.0})), 1.0);
}

TEST(UniformStep, IsNothingWhenStepsDiffer) {
  EXPECT_FALSE(uniform_step(record_at({0.0, 1.0, 2.1})));
  EXPECT_TRUE(uniform_step(record_at({0.0, 1.0, 2.1}), 0.1));
}

TEST(UniformStep, IsNothingForFewerThanTwoSamples) {
  EXPECT_FALSE(uniform_step(record_at({})));
  EXPECT_FALSE(uniform_step(record_at({1.0})));
}

TEST(Steps, HaveAMean) {
  const Trajectory record = record_at({0.0, 1.0, 2.0, 6.0});
  EXPECT_DOUBLE_EQ(record.duration(), 6.0);
  EXPECT_DOUBLE_EQ(mean_step(record), 2.0);
}

TEST(RowsOf, AreTheSamplesOfAllThatThereIs) {
  Trajectory record = record_at({0.0, 1.0, 2.0, 6.0});
  record.source = "a.csv";
  record.states = Matrix::Random(4, 2);
  record.derivatives = Matrix::Random(4, 2);
  const Trajectory part = rows_of(record, 1, 2);
  EXPECT_EQ(part.source, "a.csv");
  EXPECT_EQ(part.time, (Vector{{1.0, 2.0}}));
  EXPECT_EQ(part.states, Matrix(record.states.middleRows(1, 2)));
  EXPECT_EQ(part.derivatives, Matrix(record.derivatives.middleRows(1, 2)));
  EXPECT_EQ(part.inputs.size(), 0) << "0 x 0 stays what it is";
  record.derivatives.resize(0, 0);
  EXPECT_FALSE(rows_of(record, 1, 2).has_derivatives());
}

TEST(GoesOn, AfterAShortGapInTheSameFile) {
  Trajectory before = record_at({0.0, 1.0}), after = record_at({3.0, 4.0});
  before.source = "run.csv, piece 1";
  after.source = "run.csv, piece 2";
  EXPECT_EQ(file_of(after), "run.csv");
  EXPECT_TRUE(goes_on(before, after, 2.0));
  EXPECT_FALSE(goes_on(before, after, 1.9));
  EXPECT_FALSE(goes_on(after, before, 9.0));
  before.source = "run.csv, record 1";
  after.source = "run.csv, record 2";
  EXPECT_FALSE(goes_on(before, after, 2.0)) << "a record begins there";
  before.source = "run.csv, record 2, piece 1";
  after.source = "run.csv, record 2, piece 2";
  EXPECT_EQ(file_of(after), "run.csv");
  EXPECT_TRUE(goes_on(before, after, 2.0));
  after.source = "other.csv, record 2, piece 2";
  EXPECT_FALSE(goes_on(before, after, 2.0));
}

}  // namespace
}  // namespace lacuna
