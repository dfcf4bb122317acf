// SPDX-License-Identifier: MIT
#include "diagnose/search/function_basis.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnose/candidates/candidate_column.hpp"
#include "trajectories/smoother/value_periods.hpp"
#include "lacuna/trajectories/sensitivities/linearised_record.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

using Kind = FunctionBasis::Kind;

/// The first basis of a kind in the given variables with at least so many members.
FunctionBasis basis_of(const std::vector<FunctionBasis>& bases, Kind kind,
                       const std::vector<std::string>& variables, std::size_t least = 1) {
  const auto found = std::find_if(bases.begin(), bases.end(), [&](const FunctionBasis& basis) {
    return basis.kind == kind && basis.variables == variables && basis.members.size() >= least;
  });
  return found != bases.end() ? *found : FunctionBasis{};
}

/// The members on samples and midpoints of the oscillator's record, one column each.
Matrix values_of(const FunctionBasis& basis) {
  const Dataset data = support::oscillator_record();
  const LinearisedRecord grid =
      grid_of(data.inputs, data.trajectories.front(), data.trajectories.front().states);
  std::vector<Expression> forms;
  for (const Candidate& member : basis.members) forms.push_back(member.form);
  return evaluate_on(grid, support::oscillator().variables(), forms);
}

/// The nominal model on a record in which nothing is hidden.
const Assimilation& oscillator_fit() {
  static const Assimilation fit =
      support::assimilated(support::hidden_record(support::nothing, 0.01));
  return fit;
}

TEST(FunctionBasis, SplinesSumToOneAndHoldTheStraightLine) {
  const Scope scope = support::oscillator_scope();
  const auto bases = present_functions(oscillator_fit(), scope, 1);
  for (const std::size_t pieces : {8u, 24u}) {
    const FunctionBasis curve = basis_of(bases, Kind::Curve, {"q"}, pieces);
    ASSERT_EQ(curve.members.size(), pieces);
    const Matrix values = values_of(curve);
    EXPECT_LT((values.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-9);
    EXPECT_GE(values.minCoeff(), -1e-12);
    EXPECT_LE((values.array() > 1e-12).rowwise().count().maxCoeff(), 4)
        << "cubic: four at once";
    // The middles of uniform splines are their Greville abscissae: sum middle_j B_j(q) = q.
    const VariableRange& q = scope.variables[0];
    ASSERT_EQ(q.name, "q");
    const double width = (q.high - q.low) / (static_cast<double>(pieces) - 3.0);
    const auto count = static_cast<Index>(pieces);
    const Vector middles = Vector::LinSpaced(
        count, q.low - width, q.low + width * (static_cast<double>(pieces) - 2.0));
    const Vector line = values_of({Kind::Curve, {"q"}, {support::plain_candidate("q")}});
    EXPECT_LT((values * middles - line).cwiseAbs().maxCoeff(), 1e-9);
  }
}

/// Drop of the sum of squares of the innovations by dense least squares.
double dense_drop(const Assimilation& fit, const FunctionBasis& basis) {
  const InnovationSystem system(fit);
  const Matrix fitted = system.fitted_columns();
  Matrix all(fitted.rows(), fitted.cols() + static_cast<Index>(basis.members.size()));
  all.leftCols(fitted.cols()) = fitted;
  for (std::size_t j = 0; j < basis.members.size(); ++j)
    all.col(fitted.cols() + static_cast<Index>(j)) =
        *candidate_column(basis.members[j], {}, fit, system);
  const auto left = [&](const Matrix& columns) {
    const Vector& target = system.innovations();
    return (target - columns * columns.completeOrthogonalDecomposition().solve(target))
        .squaredNorm();
  };
  return left(fitted) - left(all);
}

class Scoring : public testing::Test {
 protected:
  support::Asked asked_ = support::asked(support::ripple);
  std::shared_ptr<const Baseline> base_ = asked_.baseline();
};

TEST_F(Scoring, TheGainIsTheDropOfLeastSquares) {
  const FunctionScreening screening(base_->fitted);
  FunctionBasis cubes{Kind::Curve, {"q"}, {}};
  for (const char* form : {"q^2", "q^3", "q^4"})
    cubes.members.push_back(support::plain_candidate(form));
  const double drop = dense_drop(base_->fitted, cubes);
  EXPECT_NEAR(screening.score(cubes).gain, drop, 1e-6 * drop);
  EXPECT_EQ(screening.score(cubes).members, (std::vector<std::size_t>{0, 1, 2}));
}

TEST_F(Scoring, TheBestIsAFunctionOfTheRightVariable) {
  const FunctionScreening screening(base_->fitted);
  const auto best = screening.best_of(present_functions(base_->fitted, base_->scope, 1),
                                      *asked_.options.criterion);
  ASSERT_TRUE(best);
  EXPECT_EQ(best->basis.kind, Kind::Curve);
  EXPECT_EQ(best->basis.variables, std::vector<std::string>{"q"});
  const double members = static_cast<double>(best->score.members.size());
  EXPECT_NEAR(best->net, best->score.gain - members * std::log(2.0 * 1501.0), 1e-6);
  EXPECT_EQ(best->members().size(), best->score.members.size());
  EXPECT_FALSE(screening.best_of({}, *asked_.options.criterion));
}

TEST_F(Scoring, WhatRecursIsInBothHalves) {
  const auto smaller_half = [](const support::Hidden& hidden) {
    const auto base = support::asked(hidden).baseline();
    FunctionBasis waves{Kind::Lines, {"t"}, {}};
    for (const char* form : {"sin(5*t)", "cos(5*t)"})
      waves.members.push_back(support::plain_candidate(form));
    return FunctionScreening(base->fitted).smaller_half(waves);
  };
  EXPECT_GT(smaller_half([](double t, double, double) { return std::sin(5.0 * t); }), 0.4);
  EXPECT_LT(smaller_half([](double t, double, double) {
              return t < 8.0 ? 3.0 * std::sin(5.0 * t) : 0.0;
            }),
            0.05);
}

/// A force that repeats every 0.31 m: periods in the range are known to a quarter, and a
/// quarter of one at a time is tried from two on.
TEST(PeriodSearch, FindsWhatRepeatsAlongAVariable) {
  constexpr double kPeriod = 0.31;
  const auto teeth = [](double, double q, double) {
    return 1.5 * std::sin(2.0 * std::numbers::pi * q / kPeriod + 0.4);
  };
  const Assimilation fit = support::assimilated(support::hidden_record(teeth, 0.002));
  const auto found = best_period(fit, 1, 0);
  ASSERT_TRUE(found);
  const auto q = fit.records.front().path.col(0).array();
  const double range = q.maxCoeff() - q.minCoeff();
  EXPECT_NEAR(range / found->longest, range / kPeriod, 0.25);
  EXPECT_LT(found->shortest, kPeriod);
  EXPECT_NEAR(static_cast<double>(found->tried), 4.0 * (range / found->shortest - 2.0) + 1.0,
              1.5);
}

}  // namespace
}  // namespace lacuna
