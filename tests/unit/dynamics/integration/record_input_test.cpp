// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/record_input.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Trajectory sine(Index n, double h) {
  Trajectory trajectory;
  trajectory.time = Vector::LinSpaced(n, 0.0, h * static_cast<double>(n - 1));
  trajectory.inputs.resize(n, 2);
  trajectory.inputs.col(0) = trajectory.time.array().sin();
  trajectory.inputs.col(1) = trajectory.time.array().cos();
  return trajectory;
}

double worst_error(RecordInput input, double end) {
  double worst = 0.0;
  for (double t = 0.0; t <= end; t += 0.0137) {
    double u[2];
    input(t, u);
    worst = std::max({worst, std::abs(u[0] - std::sin(t)), std::abs(u[1] - std::cos(t))});
  }
  return worst;
}

TEST(RecordInput, IsQuinticUnlessToldOtherwise) {
  const double coarse = worst_error(RecordInput(sine(51, 0.2)), 10.0);
  const double fine = worst_error(RecordInput(sine(101, 0.1)), 10.0);
  EXPECT_NEAR(std::log2(coarse / fine), 6.0, 0.4);
}

TEST(RecordInput, TwoPointsAreAStraightLine) {
  RecordInput input(Vector{{0.0, 1.0, 3.0}}, Vector{{0.0, 2.0, 0.0}}, Interpolation::Linear);
  double u = 0.0;
  input(0.25, &u);
  EXPECT_DOUBLE_EQ(u, 0.5);
  input(2.0, &u);
  EXPECT_DOUBLE_EQ(u, 1.0);
}

TEST(RecordInput, OnePointHoldsTheLastSample) {
  RecordInput input(Vector{{0.0, 1.0, 3.0}}, Vector{{5.0, 6.0, 7.0}}, Interpolation::Held);
  double u = 0.0;
  input(0.99, &u);
  EXPECT_EQ(u, 5.0);
  input(1.0, &u);
  EXPECT_EQ(u, 6.0);
  input(3.0, &u);
  EXPECT_EQ(u, 7.0);
}

TEST(RecordInput, EndsHoldOutsideOfTheRecord) {
  RecordInput input(sine(51, 0.2));
  double u[2];
  input(-3.0, u);
  EXPECT_EQ(u[1], 1.0);
  input(99.0, u);
  EXPECT_DOUBLE_EQ(u[0], std::sin(10.0));
}

TEST(RecordInput, EachInputGoesOnInItsOwnWay) {
  Trajectory run = sine(51, 0.2);
  const std::vector<Quantity> inputs{{"a", "", Hold::Zero}, {"b", ""}};
  RecordInput input(run, inputs);
  double u[2];
  input(1.1, u);
  EXPECT_EQ(u[0], run.inputs(5, 0));
  EXPECT_NEAR(u[1], std::cos(1.1), 1e-4);
  EXPECT_EQ(input.breaks(), run.time);
  EXPECT_EQ(RecordInput(run).breaks().size(), 0) << "smooth inputs have no breaks";
}

TEST(RecordInput, ShapesMustFit) {
  EXPECT_THROW(RecordInput(Vector{{0.0, 1.0}}, Matrix::Zero(3, 1)), ArgumentError);
  EXPECT_THROW(RecordInput(sine(51, 0.2), std::vector<Quantity>{{"a", ""}}), ArgumentError);
}

}  // namespace
}  // namespace lacuna
