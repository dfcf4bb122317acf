// SPDX-License-Identifier: MIT
#include "identify/forms_beside/form_rows.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

/// x = 2 cos t, y = -2 sin t: dx/dt = y, dy/dt = -x.
Dataset circle(Index n, double noise) {
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(n, 0.0, 20.0);
  record.states.resize(n, 2);
  record.inputs.resize(n, 0);
  Random random(1);
  for (Index i = 0; i < n; ++i) {
    record.states(i, 0) = 2.0 * std::cos(record.time[i]) + noise * random.normal();
    record.states(i, 1) = -2.0 * std::sin(record.time[i]) + noise * random.normal();
  }
  data.trajectories = {record};
  return data;
}

TEST(FormRows, HoldWhereTheEquationDoes) {
  const FormRows rows(circle(2001, 0.0), Vector::Zero(2));
  const Matrix columns =
      rows.columns({parse_expression("x"), parse_expression("y"), parse_expression("x*y")});
  ASSERT_EQ(columns.rows(), rows.rows());
  EXPECT_GT(rows.rows(), 200);
  EXPECT_LT((columns.col(1) - rows.target(0)).norm(), 1e-6 * rows.target(0).norm());
  EXPECT_LT((columns.col(0) + rows.target(1)).norm(), 1e-6 * rows.target(1).norm());
}

TEST(FormRows, MeasuredRatesAreTheTargetWithoutAnErrorOfQuadrature) {
  Dataset data = circle(101, 0.0);
  Trajectory& record = data.trajectories[0];
  record.derivatives = record.states;
  record.derivatives.col(0) = record.states.col(1);
  record.derivatives.col(1) = -record.states.col(0).array().cube().matrix();
  const FormRows rows(data, Vector::Zero(2));
  const Matrix columns = rows.columns({parse_expression("y"), parse_expression("x^3")});
  EXPECT_LT((columns.col(0) - rows.target(0)).norm(), 1e-13 * rows.target(0).norm());
  EXPECT_LT((columns.col(1) + rows.target(1)).norm(), 1e-13 * rows.target(1).norm());
  EXPECT_EQ(rows.samples(), 99) << "test functions are 0 at their ends";
  EXPECT_EQ(rows.rate(0), record.derivatives.col(0).segment(1, 99));
}

TEST(FormRows, OfALongRecordKeepTheSamplesWithinTestFunctions) {
  // 20 000 turns of 20 samples: a thousand rows are far apart.
  Dataset data = circle(200001, 0.0);
  Trajectory& record = data.trajectories[0];
  record.time *= 1000.0;
  for (Index i = 0; i < record.samples(); ++i)
    record.states.row(i) << 2.0 * std::cos(record.time[i]), -2.0 * std::sin(record.time[i]);
  const FormRows rows(data, Vector::Zero(2));
  EXPECT_LT(rows.samples(), 160000);
  const Expression y = parse_expression("y");
  EXPECT_EQ(rows.values({y}).rows(), rows.samples());
  EXPECT_LT((rows.values({y}).col(0) - rows.rate(0)).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((rows.columns({y}).col(0) - rows.target(0)).norm(), 1e-3 * rows.target(0).norm());
  EXPECT_EQ(rows.projected(rows.values({y})), rows.columns({y}));
}

}  // namespace
}  // namespace lacuna
