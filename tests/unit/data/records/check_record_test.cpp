// SPDX-License-Identifier: MIT
#include "data/records/check_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

Dataset two_states() {
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  data.inputs = {{"u", ""}};
  data.trajectories.resize(1);
  Trajectory& record = data.trajectories[0];
  record.time = Vector::LinSpaced(5, 0.0, 4.0);
  record.states = Matrix::Ones(5, 2);
  record.inputs = Matrix::Ones(5, 1);
  return data;
}

TEST(CheckRecord, RowsAreAsManyAsTimes) {
  Dataset data = two_states();
  Trajectory& record = data.trajectories[0];
  EXPECT_NO_THROW(check_rows(record, "f"));
  record.marks = Matrix::Zero(4, 2);
  EXPECT_THROW(check_rows(record, "f"), ArgumentError);
  record.marks.resize(0, 0);
  record.inputs = Matrix::Ones(6, 1);
  EXPECT_THROW(check_rows(record, "f"), ArgumentError);
  record.inputs = Matrix::Ones(5, 1);
  record.states = Matrix::Ones(4, 2);
  EXPECT_THROW(check_rows(record, "f"), ArgumentError);
}

TEST(CheckRecord, ColumnsAreThoseOfTheDataset) {
  Dataset data = two_states();
  EXPECT_NO_THROW(check_columns(data, "f"));
  EXPECT_NO_THROW(check_input(data, 0, "f"));
  EXPECT_THROW(check_input(data, 1, "f"), ArgumentError);
  EXPECT_THROW(check_input(data, -1, "f"), ArgumentError);
  data.trajectories[0].inputs = Matrix(5, 0);
  EXPECT_THROW(check_columns(data, "f"), ArgumentError);
  data.inputs.clear();
  EXPECT_NO_THROW(check_columns(data, "f"));
  data.states.pop_back();
  EXPECT_THROW(check_columns(data, "f"), ArgumentError);
  EXPECT_THROW(check_states(data, "f"), ArgumentError);
}

TEST(CheckRecord, StatesAreFiniteWhereTheySaySomething) {
  Dataset data = two_states();
  Trajectory& record = data.trajectories[0];
  EXPECT_NO_THROW(check_states(data, "f"));
  EXPECT_THROW(check_state(record, 2, "f"), ArgumentError);
  record.states(3, 1) = std::nan("");
  EXPECT_THROW(check_states(data, "f"), ArgumentError);
  EXPECT_THROW(check_state(record, 1, "f"), ArgumentError);
  EXPECT_NO_THROW(check_state(record, 0, "f"));
  set_mark(record, 3, 1, Mark::Missing);
  EXPECT_NO_THROW(check_states(data, "f"));
  record.states(0, 0) = INFINITY;
  EXPECT_THROW(check_states(data, "f"), ArgumentError);
}

}  // namespace
}  // namespace lacuna
