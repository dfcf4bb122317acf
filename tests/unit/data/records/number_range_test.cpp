// SPDX-License-Identifier: MIT
#include "data/records/number_range.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "data/records/far_variables.hpp"
#include "data/records/lattice.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

constexpr Index kSamples = 50;

Dataset record(double scale, double offset, double step = 0.1) {
  Trajectory run{"r.csv", Vector(kSamples), Matrix(kSamples, 1), Matrix(kSamples, 0), {}};
  for (Index i = 0; i < kSamples; ++i) {
    run.time[i] = step * static_cast<double>(i);
    run.states(i, 0) = scale * (std::cos(0.3 * static_cast<double>(i)) + offset);
  }
  return {"s", {{"x", ""}}, {}, {run}, {}};
}

TEST(NumberRange, OrdinarySizesAreFine) {
  for (const double scale : {1e-30, 1e-3, 1.0, 1e30})
    EXPECT_NO_THROW(check_number_range(record(scale, 0.0))) << scale;
  for (const double offset : {1.0, 1e6, 1e8})
    EXPECT_NO_THROW(check_number_range(record(1.0, offset))) << offset;
  EXPECT_NO_THROW(check_number_range(record(0.0, 1.0))) << "0 throughout";
  EXPECT_NO_THROW(check_number_range(Dataset{}));
}

TEST(NumberRange, SizesAndStepsBeyondItAreRefusedWithTheRemedy) {
  for (const double scale : {1e-200, 1e200})
    expect_error<DataError>([&] { check_number_range(record(scale, 0.0)); }, "r.csv, column x",
                            "range of numbers",
                            scale > 1.0 ? "divide by 1e200" : "divide by 1e-200");
  for (const double step : {1e-100, 1e100})
    expect_error<DataError>([&] { check_number_range(record(1.0, 0.0, step)); }, "r.csv, time",
                            "range of numbers", "another unit");
}

TEST(NumberRange, ChangesBelowTheResolutionAreRefusedWithTheOffset) {
  expect_error<DataError>([] { check_number_range(record(1.0, 1e12)); }, "r.csv, column x",
                          "of their size", "subtract the offset (999999999999");
  Dataset flat = record(1.0, 1e12);
  flat.trajectories[0].states.setConstant(1e12);
  EXPECT_NO_THROW(check_number_range(flat)) << "a constant has no change to resolve";
}

TEST(NumberRange, InputsCountAndMissingValuesDoNot) {
  Dataset data = record(1.0, 0.0);
  data.trajectories[0].states(3, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(check_number_range(data));
  data.inputs = {{"u", ""}};
  data.trajectories[0].inputs = Matrix::Constant(kSamples, 1, 1e300);
  expect_error<DataError>([&] { check_number_range(data); }, "r.csv, column u",
                          "range of numbers", "divide by 1e300");
}

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

/// A slow sine in steps, as text with digits of `digit` has them.
Dataset stepped(double step, double digit, double reach = 15.0) {
  Dataset data;
  data.states = {{"T", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(400, 0.0, 399.0);
  record.states.resize(400, 1);
  for (Index i = 0; i < 400; ++i) {
    const double value = 21.0 + reach * std::sin(0.02 * static_cast<double>(i));
    record.states(i, 0) = digit * std::round(step * std::round(value / step) / digit);
  }
  data.trajectories = {record};
  return data;
}

TEST(Lattice, OfAConverterIsFoundBehindTheDigitsOfTheText) {
  for (const double step : {0.3223, 0.2417, 0.0977, 1.0 / 7.0})
    EXPECT_NEAR(*lattice_of(stepped(step, 0.01), 0), step, 0.001 * step);
}

TEST(Lattice, OfDigitsAloneIsTheDigit) {
  EXPECT_NEAR(*lattice_of(stepped(0.01, 0.01), 0), 0.01, 1e-9);
  EXPECT_NEAR(*lattice_of(stepped(0.25, 1e-4), 0), 0.25, 1e-9);
}

TEST(Lattice, IsFoundBehindFewSignificantDigits) {
  // An encoder of 4096 steps a turn, printed with five digits.
  Dataset data = stepped(2.0 * std::acos(-1.0) / 4096.0, 1e-12, 1.3);
  for (Trajectory& record : data.trajectories) {
    record.states.array() -= 21.0;
    for (double& value : record.states.reshaped()) {
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%.5g", value);
      value = std::strtod(text.data(), nullptr);
    }
  }
  EXPECT_NEAR(*lattice_of(data, 0), 2.0 * std::acos(-1.0) / 4096.0, 1e-6);
}

TEST(Lattice, IsNoneOfFewLevels) { EXPECT_FALSE(lattice_of(stepped(5.0, 0.01), 0)); }

/// Values that are spread without a step have the digits of their text and no other.
TEST(Lattice, OfSparseValuesIsTheDigit) {
  Dataset data = stepped(0.01, 0.01);
  Matrix& states = data.trajectories[0].states;
  for (Index i = 0; i < states.rows(); ++i)
    states(i, 0) = 0.01 * std::round(100.0 * std::fmod(7.123 * static_cast<double>(i), 97.0));
  EXPECT_NEAR(*lattice_of(data, 0), 0.01, 1e-9);
}

/// The smallest gap is twice the spacing, and so are hundreds of others.
TEST(Lattice, OfManyLevelsIsThatOfTheirLargeGapsToo) {
  Dataset data = stepped(0.01, 0.01);
  Matrix& states = data.trajectories[0].states;
  double level = 0.0;
  for (Index i = 0; i < states.rows(); ++i) {
    states(i, 0) = 0.01 * level;
    level += i % 4 == 3 ? 3.0 : 2.0;
  }
  ASSERT_EQ(states.rows(), 400);
  EXPECT_NEAR(*lattice_of(data, 0), 0.01, 1e-9);
}

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
