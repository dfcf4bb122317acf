// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "identify/forms_beside/base_columns.hpp"
#include "identify/forms_beside/form_problem.hpp"
#include "identify/forms_beside/form_rows.hpp"

namespace lacuna {
namespace {

/// x = 2 cos t, y = -2 sin t: dx/dt = y, dy/dt = -x.
Dataset circle(Index n, double noise, double length = 20.0, std::uint64_t seed = 1) {
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(n, 0.0, length);
  record.states.resize(n, 2);
  record.inputs.resize(n, 0);
  Random random(seed);
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

Matrix noise(Index rows, Index columns, std::uint64_t seed) {
  Random random(seed);
  Matrix values(rows, columns);
  for (double& value : values.reshaped()) value = random.normal();
  return values;
}

Matrix joined(const Matrix& columns, const Matrix& more) {
  Matrix all(columns.rows(), columns.cols() + more.cols());
  all.leftCols(columns.cols()) = columns;
  all.rightCols(more.cols()) = more;
  return all;
}

TEST(BaseColumns, OneColumnMoreLeavesWhatLeastSquaresLeaves) {
  const Matrix columns = noise(40, 5, 1);
  const Vector target = noise(40, 1, 2), more = noise(40, 1, 3);
  const BaseColumns base(columns, target);
  EXPECT_NEAR(base.left(), residual_squares(columns, target), 1e-12);
  EXPECT_NEAR(base.left_with(more), residual_squares(joined(columns, more), target), 1e-12);
  EXPECT_NEAR(base.left_with(columns.col(2)), base.left(), 1e-12);
  EXPECT_NEAR(BaseColumns(Matrix(40, 0), target).left_with(more),
              residual_squares(more, target), 1e-12);
}

TEST(BaseColumns, TheRestIsWhatLeastSquaresLeavesOfEachRow) {
  const Matrix columns = noise(40, 5, 21);
  const Vector target = noise(40, 1, 22), more = noise(40, 1, 23);
  const BaseColumns base(columns, target);
  const Matrix all = joined(columns, more);
  const Vector rest = target - all * all.householderQr().solve(target);
  EXPECT_LT((base.rest_with(more) - rest).norm(), 1e-12);
  EXPECT_NEAR(base.rest_with(columns.col(2)).squaredNorm(), base.left(), 1e-12);
  const Vector broken = Vector::Constant(40, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(base.rest_with(broken).allFinite());
}

TEST(BaseColumns, APairLeavesWhatLeastSquaresLeavesAndHasItsCoefficients) {
  const Matrix columns = noise(40, 5, 11);
  const Vector first = noise(40, 1, 12), second = 30.0 * noise(40, 1, 13);
  const Vector target = noise(40, 1, 14) + 2.0 * first - 0.5 * second;
  const BaseColumns base(columns, target);
  const BaseColumns::Pair pair = base.with_pair(first, second);
  const Matrix all = joined(joined(columns, first), second);
  EXPECT_NEAR(pair.left, residual_squares(all, target), 1e-11);
  const Vector h = all.householderQr().solve(target);
  EXPECT_NEAR(pair.first, h[5], 1e-11);
  EXPECT_NEAR(pair.second, h[6], 1e-11);
  EXPECT_NEAR(base.with_pair(columns.col(1), columns.col(2)).left, base.left(), 1e-11);
}

/// Without the column that is missed least beside another.
Matrix without_least(const Matrix& columns, const Matrix& more, const Vector& target) {
  double least = std::numeric_limits<double>::infinity();
  Matrix best;
  for (Index i = 0; i < columns.cols(); ++i) {
    std::vector<Index> kept;
    for (Index c = 0; c < columns.cols(); ++c)
      if (c != i) kept.push_back(c);
    const Matrix few = columns(Eigen::all, kept);
    const double left = residual_squares(joined(few, more), target);
    if (left < least) best = few;
    least = std::min(least, left);
  }
  return best;
}

TEST(BaseColumns, WithoutSomeTheyGoOneByOneAsTheyAreMissed) {
  const Matrix columns = noise(40, 5, 4), none(40, 0);
  const Vector target = noise(40, 1, 5), more = noise(40, 1, 6);
  const BaseColumns base(columns, target);
  Matrix beside = columns, alone = columns;
  for (Index gone = 0; gone <= 5; ++gone) {
    EXPECT_NEAR(base.left_without(gone, more), residual_squares(joined(beside, more), target),
                1e-10);
    EXPECT_NEAR(base.left_without(gone), residual_squares(alone, target), 1e-10);
    if (gone == 5) break;
    beside = without_least(beside, more, target);
    alone = without_least(alone, none, target);
  }
  EXPECT_TRUE(std::isinf(base.left_without(6)));
  EXPECT_TRUE(std::isinf(base.left_without(1, columns.col(2)))) << "nothing new";
}

constexpr double kNoise = 0.01;

Dataset noisy_circle(std::uint64_t seed) { return circle(2001, kNoise, 40.0, seed); }

EquationForms rate_of_x(const FormProblem& problem, const std::string& term) {
  return {0, {Term(parse_expression(term), problem.all_rows().variables())}, {}};
}

TEST(NoiseResidual, IsWhatNoiseLeavesOfARightEquationOnAverage) {
  constexpr int kRecords = 40;
  const Vector noise = Vector::Constant(2, kNoise);
  double sum = 0.0, squares = 0.0;
  NoiseSquares expected;
  for (int seed = 1; seed <= kRecords; ++seed) {
    const FormProblem problem(noisy_circle(static_cast<std::uint64_t>(seed)), noise);
    const double left = problem.left(rate_of_x(problem, "y"));
    sum += left;
    squares += left * left;
    Matrix sensitivity = Matrix::Zero(problem.all_rows().samples(), 2);
    sensitivity.col(1).setOnes();
    expected = problem.all_rows().noise_squares(sensitivity, noise, 0);
    EXPECT_GT(expected.mean, 1.02 * problem.residual_noise(0)) << "noise of y counts as well";
  }
  const double mean = sum / kRecords;
  const double deviation = std::sqrt(squares / kRecords - mean * mean);
  // Of a mean of 40, and of a deviation of 40.
  EXPECT_NEAR(mean, expected.mean, 4.0 * expected.deviation / std::sqrt(1.0 * kRecords));
  EXPECT_NEAR(deviation, expected.deviation, 0.45 * expected.deviation);
}

TEST(NoiseResidual, SaysWhereAFormWouldFitNoise) {
  const FormProblem problem(noisy_circle(1), Vector::Constant(2, kNoise));
  constexpr double kHalf = 0.5;
  EXPECT_TRUE(problem.would_fit_noise(rate_of_x(problem, "y"), kHalf));
  EXPECT_FALSE(problem.would_fit_noise(rate_of_x(problem, "y"), 1.5));
  EXPECT_FALSE(problem.would_fit_noise(rate_of_x(problem, "y^3"), kHalf));
  EXPECT_FALSE(problem.would_fit_noise({0, {}, {}}, kHalf));
}

}  // namespace
}  // namespace lacuna
