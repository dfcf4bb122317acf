// SPDX-License-Identifier: MIT
#include "lacuna/data/records/marks.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

Trajectory four_samples() {
  Trajectory record;
  record.time = Vector{{0.0, 1.0, 2.0, 3.0}};
  record.states = Matrix{{1.0, 5.0}, {2.0, 6.0}, {3.0, 7.0}, {4.0, 8.0}};
  return record;
}

TEST(Marks, WithoutMarksEverySampleIsAValue) {
  const Trajectory record = four_samples();
  EXPECT_EQ(mark_of(record.marks, 2, 1), Mark::Value);
  EXPECT_TRUE(marks_of(record).isZero());
  EXPECT_EQ(marks_of(record).rows(), 4);
}

TEST(Marks, ValuesAreTheSamplesThatAreMeasured) {
  Trajectory record = four_samples();
  set_mark(record, 1, 1, Mark::Missing);
  set_mark(record, 3, 1, Mark::AtTop);
  const Trajectory values = values_of(record, 1);
  EXPECT_EQ(values.time, (Vector{{0.0, 2.0}}));
  EXPECT_EQ(values.states, (Matrix{{5.0}, {7.0}}));
  EXPECT_EQ(values_of(record, 0).samples(), 4) << "the other state has all";
}

TEST(Marks, OnlyAnEndAndAValueSaySomething) {
  EXPECT_TRUE(says_something(Mark::Value) && says_something(Mark::AtBottom));
  EXPECT_FALSE(says_something(Mark::Outlier) || says_something(Mark::Missing));
}

TEST(Filled, GoesStraightFromWhatSaysSomething) {
  const double no = number_of(Mark::Outlier), end = number_of(Mark::AtTop);
  const Matrix states{{9.0, 1.0}, {2.0, 9.0}, {9.0, 9.0}, {9.0, 4.0}, {8.0, 9.0}};
  const Matrix marks{{no, 0.0}, {end, no}, {no, no}, {no, 0.0}, {0.0, no}};
  EXPECT_TRUE(
      filled(states, marks)
          .isApprox(Matrix{{2.0, 1.0}, {2.0, 2.0}, {4.0, 3.0}, {6.0, 4.0}, {8.0, 4.0}}));
  EXPECT_EQ(filled(states, Matrix()), states);
  const Matrix none = Matrix::Constant(5, 2, no);
  EXPECT_EQ(filled(states, none), states) << "nothing to go by";
}

TEST(Marks, GoWithTheRows) {
  Trajectory record = four_samples();
  set_mark(record, 2, 0, Mark::AtBottom);
  const Trajectory part = rows_of(record, 1, 2);
  EXPECT_EQ(mark_of(part.marks, 1, 0), Mark::AtBottom);
  EXPECT_EQ(mark_of(part.marks, 0, 0), Mark::Value);
}

}  // namespace
}  // namespace lacuna
