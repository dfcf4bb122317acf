// SPDX-License-Identifier: MIT
#include "data/records/number_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lacuna/core/base/error.hpp"
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

}  // namespace
}  // namespace lacuna
