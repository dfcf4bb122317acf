// SPDX-License-Identifier: MIT
// Rows of a search for forms, and what forms leave of them.
#include "identify/forms_beside/form_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "identify/forms_beside/base_columns.hpp"
#include "identify/forms_beside/form_rows.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

/// x with dx/dt = -x, exactly.
Dataset decay() {
  Trajectory record;
  record.time = Vector::LinSpaced(801, 0.0, 4.0);
  record.states = (-record.time.array()).exp().matrix();
  return support::one_record({{"x", ""}}, {}, record);
}

Candidate form_of_x(const std::string& form) {
  const Expression x = Expression::variable("x");
  Candidate candidate;
  candidate.form = parse_expression(form);
  candidate.argument = x;
  candidate.starts = {Vector()};
  return candidate;
}

TEST(FormProblem, WhatIsTheSameIsATenthWhereItIsNoNoise) {
  const FormProblem clean(decay(), Vector::Zero(1), {});
  EXPECT_NEAR(clean.same_as(1.0, clean.residual_noise(0)), 1.21, 1e-12);
  const FormProblem noisy(decay(), Vector::Constant(1, 0.1), {});
  const double noise = noisy.residual_noise(0);
  const auto rows = static_cast<double>(noisy.rows());
  EXPECT_NEAR(noise, 0.01 * rows, 1e-6 * noise);
  EXPECT_NEAR(noisy.same_as(noise, noise), noise * (1.0 + 2.0 * std::log(rows) / rows), 1e-9);
}

TEST(FormProblem, WhatTrajectoriesCallNoiseIsNoise) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const EquationForms constant{0, {problem.linear_terms()[0]}, {}};
  const double left = problem.left(constant);
  const auto rows = static_cast<double>(problem.rows());
  const Limit unknown = problem.limit_of(constant);
  EXPECT_NEAR(unknown.left, 1.21 * left, 1e-9 * left);
  EXPECT_EQ(unknown.penalty, 0.0);
  const Limit noise = problem.limit_of(constant, Remainder::Noise);
  EXPECT_NEAR(noise.left, left * (1.0 + 2.0 * std::log(rows) / rows), 1e-9 * left);
  EXPECT_NEAR(noise.penalty, std::log(rows) / rows * left, 1e-9 * left);
}

TEST(FormProblem, RatesFormsByWhatTheyTakeInThePlaceOfMembers) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const std::vector<Term> terms = problem.linear_terms();
  ASSERT_EQ(terms.size(), 2u);
  const EquationForms linear{0, terms, {}};
  const std::vector<Start> starts{{{form_of_x("exp(x)"), Vector()}, 0, 0.0}};
  const auto rating = [&](const Beside& beside) { return problem.rated({beside}, starts)(0, 0); };
  EquationForms alone{0, {}, {starts[0].form}};
  // Two parameters: one of the members goes; one parameter: both.
  double one = problem.left({0, {terms[0]}, alone.forms});
  one = std::min(one, problem.left({0, {terms[1]}, alone.forms}));
  EXPECT_NEAR(rating({linear, 2, 0, 1e-9, 0.0}), one, 1e-9 * one);
  const double left = problem.left(alone), bare = problem.left(EquationForms{0, {}, {}});
  ASSERT_LT(left, bare);
  EXPECT_NEAR(rating({linear, 1, 0, 1e-9, 0.0}), left, 1e-9 * left);
  // What it takes of all that is left, or of what is beyond a limit.
  const double taken = (bare - left) / bare, limit = 0.5 * bare;
  EXPECT_TRUE(std::isfinite(rating({linear, 1, 0, 0.999 * taken, 0.0})));
  EXPECT_TRUE(std::isinf(rating({linear, 1, 0, 1.001 * taken, 0.0})));
  EXPECT_TRUE(std::isfinite(rating({linear, 1, 0, std::min(1.0, 1.9 * taken), limit})));
  EXPECT_TRUE(std::isinf(rating({linear, 1, 1}))) << "no place for a member";
  EXPECT_TRUE(std::isfinite(rating({linear, 2, 1})));
}

/// What is left without the member that costs least, the last one apart: each is tried.
double least_without_one(const FormProblem& problem, const EquationForms& all) {
  EquationForms fewer = all;
  fewer.terms.clear();
  double least = problem.left(fewer);
  for (std::size_t i = 0; i + 1 < all.forms.size(); ++i) {
    fewer = all;
    fewer.forms.erase(fewer.forms.begin() + static_cast<std::ptrdiff_t>(i));
    least = std::min(least, problem.left(fewer));
  }
  return least;
}

/// A form with a bend at e, which stays at a half.
MissingForm bend(const std::string& form) {
  Candidate candidate = form_of_x(form);
  candidate.shapes = {{"e", "", 0.5, 0.5, false}};
  candidate.starts = {Vector::Constant(1, 0.5)};
  return {candidate, Vector::Constant(1, 0.5)};
}

TEST(FormProblem, OfMembersThatStandForOneAnotherThoseOfMostParametersGo) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const EquationForms all{  // the forms are x together
      0, {problem.linear_terms()[1]}, {bend("max(x-e,0)"), bend("min(x,e)")}};
  const double limit = 1e6 * problem.residual_noise(0);
  const Trial thin = problem.thinned(all, {form_of_x("sin(x)"), Vector()}, {limit, 0.0, 9});
  ASSERT_EQ(thin.equation.terms.size(), 1u);
  EXPECT_EQ(thin.equation.terms[0].name(), "x");
  EXPECT_EQ(thin.equation.forms.size(), 1u);
}

TEST(FormProblem, ThinnedDropsWhatCostsLeast) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const std::vector<std::string> pool{"x^2",     "x^3",      "exp(x)",
                                      "sqrt(x)", "sin(3*x)", "cos(2*x)"};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t last = 0; last < 6; ++last) {
        if (last == i || last == j) continue;
        const MissingForm form{form_of_x(pool[last]), Vector()};
        EquationForms few{0,
                          {problem.linear_terms()[0]},
                          {{form_of_x(pool[i]), Vector()}, {form_of_x(pool[j]), Vector()}}};
        EquationForms all = few;
        all.forms.push_back(form);
        const double limit = least_without_one(problem, all) * (1.0 + 1e-6);
        const Trial thin = problem.thinned(few, form, {limit, 0.0, 2});
        EXPECT_LT(thin.equation.terms.size() + thin.equation.forms.size(), 4u)
            << pool[i] << ", " << pool[j] << ", " << pool[last];
      }
}

TEST(Limit, ANumberLessMayCostItsPenalty) {
  const Limit limit{10.0, 2.0, 5};
  EquationForms equation;
  equation.forms.push_back({form_of_x("sin(x)"), Vector::Ones(2)});
  EXPECT_DOUBLE_EQ(limit(equation), 14.0);
  EXPECT_TRUE(Limit::prefers({{}, 9.0}, {equation, 1.0}));
  EXPECT_FALSE(Limit::prefers({equation, 2.0}, {equation, 1.0}));
}

TEST(FormProblem, TriesOnlyWhatMayComeToWhatIsWanted) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const EquationForms constant{0, {problem.linear_terms()[0]}, {}};
  const std::vector<Candidate> candidates{form_of_x("exp(x)"), form_of_x("sin(x)")};
  const std::vector<Trial> all = problem.with_each(constant, candidates);
  ASSERT_EQ(all.size(), 2u);
  // A fraction that one of them takes, and the other does not.
  const double bare = problem.left(constant);
  const double between = 1.0 - 0.5 * (all[0].left + all[1].left) / bare;
  const FormProblem choosy(decay(), Vector::Zero(1), {.takes = between});
  const std::vector<Trial> some = choosy.with_each(constant, candidates, 1e-12 * bare);
  ASSERT_EQ(some.size(), 1u);
  EXPECT_EQ(some[0].equation.forms[0].expression().to_string(), "sin(x)");
}

TEST(FormProblem, AShapeThatGoesToAnEndOfItsRangeStaysThere) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  Candidate saturating = form_of_x("x/(a+x)");
  saturating.shapes = {{"a", "", 0.1, 2.0, true}};
  saturating.starts = {Vector::Constant(1, 0.5)};
  // The rate is linear in x: the longer the form is linear the better.
  EquationForms equation{0, {}, {{saturating, saturating.starts[0]}}};
  const double left = problem.polish(equation, 0);
  EXPECT_DOUBLE_EQ(equation.forms[0].shapes[0], 2.0);
  EXPECT_NEAR(left, problem.left(equation), 1e-9 * left);
}

/// x = 2 cos t, y = -2 sin t: dx/dt = y, dy/dt = -x.
Dataset circle(Index n, double noise, double length = 20.0, std::uint64_t seed = 1) {
  Trajectory record;
  record.time = Vector::LinSpaced(n, 0.0, length);
  record.states.resize(n, 2);
  Random random(seed);
  for (Index i = 0; i < n; ++i) {
    record.states(i, 0) = 2.0 * std::cos(record.time[i]) + noise * random.normal();
    record.states(i, 1) = -2.0 * std::sin(record.time[i]) + noise * random.normal();
  }
  return support::one_record({{"x", ""}, {"y", ""}}, {}, record);
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
