// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/weighted_sums.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/model/equations/term.hpp"

namespace lacuna {
namespace {

TEST(ExpressionList, EqualExpressionsHaveOneNumber) {
  ExpressionList list;
  const Expression x = parse_expression("sin(x)"), y = parse_expression("x*y");
  EXPECT_EQ(list.number_of(x), 0);
  EXPECT_EQ(list.number_of(y), 1);
  EXPECT_EQ(list.number_of(parse_expression("sin(x)")), 0);
  EXPECT_EQ(list.append(x), 2) << "unless it is asked for twice";
  EXPECT_EQ(list.number_of(x), 0);
}

/// 2 a - 3 c, nothing, p1 b + 0 a.
WeightedSums three_sums() {
  WeightedSums sums;
  sums.add(0, 2.0);
  sums.add(2, -3.0);
  sums.end_sum();
  sums.end_sum();
  sums.add(0, 0.0);
  sums.add(1, 0.0, 1);
  sums.end_sum();
  return sums;
}

TEST(WeightedSums, AddUpColumns) {
  WeightedSums sums = three_sums();
  sums.set(Vector{{7.0, 0.5}});
  Matrix values(2, 3), out(2, 3), expected(2, 3);
  values << 1.0, 2.0, 3.0, -4.0, 6.0, 1.0;
  expected << -7.0, 0.0, 1.0, -11.0, 0.0, 3.0;
  sums.apply(values, out);
  EXPECT_EQ(out, expected);
  const Vector point = values.row(1);
  Vector one(3);
  sums.apply(point.data(), one.data());
  EXPECT_EQ(one, expected.row(1).transpose());
}

TEST(WeightedSums, ValuesWithoutWeightMayBeAnything) {
  WeightedSums sums = three_sums();
  sums.set(Vector{{7.0, 0.5}});
  Matrix values(1, 3), out(1, 3);
  values << 1.0, 2.0, 3.0;
  values(0, 0) = std::numeric_limits<double>::quiet_NaN();
  sums.apply(values, out);
  EXPECT_EQ(out(0, 2), 1.0);
}

TEST(AddDerivatives, PlacesAreThoseThatAreNotAlwaysZero) {
  const RateForm form = {{{parse_expression("y"), 1.0}},
                         {{parse_expression("x^2"), 3.0, 0}, {parse_expression("x*y"), 2.0}}};
  ExpressionList expressions;
  PlacedSums derivatives;
  add_derivatives(form, "x", 0, expressions, derivatives);
  add_derivatives(form, "y", 1, expressions, derivatives);
  ASSERT_EQ(derivatives.places.size(), 3u);
  EXPECT_EQ(derivatives.places[0].row, 1);
  EXPECT_EQ(derivatives.places[0].column, 0);
  EXPECT_EQ(derivatives.places[1].row, 0);
  EXPECT_EQ(derivatives.places[1].column, 1);
  const Program program(expressions.list(), {{"x", "y"}, {}});
  derivatives.sums.set(Vector{{5.0}});
  const double slots[] = {2.0, -1.0, 0.0};
  Vector values(program.outputs()), out(3);
  Program::Workspace workspace;
  program.evaluate(slots, values.data(), workspace);
  derivatives.sums.apply(values.data(), out.data());
  EXPECT_EQ(out[0], 5.0 * 2.0 * 2.0 + 2.0 * -1.0);
  EXPECT_EQ(out[1], 1.0);
  EXPECT_EQ(out[2], 2.0 * 2.0);
}

}  // namespace
}  // namespace lacuna
