// SPDX-License-Identifier: MIT
#include "model/export/dialect.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

Dialect test_dialect() {
  return {.name = "test", .names = {{"x", "x"}, {"y", "y"}, {"z", "z"}, {"lambda", "lambda_"}}};
}

std::string plain(const std::string& formula) {
  return code(parse_expression(formula), test_dialect());
}

std::string sum(const std::string& formula) {
  const OdeModel model = parse_ode("input y\ninput z\ndx/dt = " + formula + "\n", "x.ode");
  return code(model.equations()[0], test_dialect());
}

TEST(Dialect, ParenthesesStandWhereTheyAreNeeded) {
  EXPECT_EQ(plain("x-(y-z)"), "x - (y - z)");
  EXPECT_EQ(plain("x-(y+z)"), "x - (y + z)");
  EXPECT_EQ(plain("(x-y)+z"), "x - y + z");
  EXPECT_EQ(plain("x/(y*z)"), "x/(y*z)");
  EXPECT_EQ(plain("x/(y/z)"), "x/(y/z)");
  EXPECT_EQ(plain("(x+y)*z"), "(x + y)*z");
  EXPECT_EQ(plain("x*(-y)"), "x*(-y)");
  EXPECT_EQ(plain("-(x+y)"), "-(x + y)");
  EXPECT_EQ(plain("(-x)^2"), "(-x)^2");
  EXPECT_EQ(plain("-x^2"), "-x^2");
  EXPECT_EQ(plain("(x^y)^z"), "(x^y)^z");
  EXPECT_EQ(plain("x^y^z"), "x^(y^z)");
  EXPECT_EQ(plain("x^(-2)"), "x^(-2)");
}

/// x + (y - z) and (x + y) - z are not the same number where x and y nearly cancel.
TEST(Dialect, KeepsTheOrderOfWhatIsComputed) {
  EXPECT_EQ(plain("x+(y-z)"), "x + (y - z)");
  EXPECT_EQ(plain("x*(y*z)"), "x*(y*z)");
  EXPECT_EQ(sum("2*x - 3*y*z + (y-z)^1 - z"), "2*x - 3*y*z + (y - z) - z");
  EXPECT_EQ(sum("-x + 0.5"), "-x + 0.5");
  EXPECT_EQ(sum("1e200*x*y - 1e-200*x*z"), "1e+200*(x*y) - 1e-200*(x*z)");
  EXPECT_EQ(sum("0"), "0");
}

/// Deeper than any formula may be.
TEST(Dialect, SumsAreAsLongAsTheyAre) {
  const Variables variables{{"x"}, {}};
  Equation equation;
  std::string expected;
  for (int i = 2; i < 3000; ++i) {
    equation.push_back({Term::parse("x^" + std::to_string(i), variables), 1.0});
    expected += (i > 2 ? " + x^" : "x^") + std::to_string(i);
  }
  EXPECT_EQ(code(equation, test_dialect()), expected);
}

TEST(Dialect, SaysHowNumbersTimeAndFunctionsAreWritten) {
  Dialect dialect = test_dialect();
  dialect.time = "time";
  dialect.power_sign = "**";
  dialect.number = number_with_point;
  dialect.calls[Operation::Asin] = called("arcsin");
  dialect.node = "v";
  const Expression formula = parse_expression("2*asin(x)+t^2+1e-5*max(x,lambda)-(-0)*x");
  EXPECT_EQ(code(formula, dialect),
            "2.0*arcsin(v(x)) + time**2.0 + 1e-05*max(v(x), v(lambda_)) - (-0.0*v(x))");
}

TEST(Dialect, GuardsPowersAndQuotients) {
  Dialect dialect = test_dialect();
  dialect.real = "real";
  dialect.scalar = "number";
  EXPECT_EQ(code(parse_expression("x^2+x^0.5+2^x+x/2"), dialect),
            "x^2 + sqrt(x) + real(2^x) + x/2");
  EXPECT_EQ(code(parse_expression("x*(1/0)+(-8)^2"), dialect),
            "x*(number(1)/0) + number(-8)^2");
}

TEST(Dialect, NamesAreThoseOfTheTable) {
  EXPECT_EQ(plain("lambda*x"), "lambda_*x");
  EXPECT_THROW(code_name("other", test_dialect()), std::out_of_range);
}

TEST(Dialect, RefusesDelaysThatItDoesNotHave) {
  EXPECT_THROW(plain("delay(x,0.5)"), ModelError);
  Dialect dialect = test_dialect();
  dialect.has_delay = true;
  EXPECT_EQ(code(parse_expression("delay(lambda,0.5)"), dialect), "delay(lambda_, 0.5)");
  EXPECT_THROW(code(parse_expression("delay(x,y)"), dialect), ModelError);
}

TEST(Dialect, RefusesWhatIsNestedTooDeepForCompilers) {
  const auto nested = [](int depth) {
    Expression formula = Expression::variable("x");
    for (int i = 0; i < depth; ++i) formula = Expression::make(Operation::Sin, {formula});
    return formula;
  };
  EXPECT_NO_THROW(code(nested(150), test_dialect()));
  EXPECT_THROW(code(nested(151), test_dialect()), ModelError);
}

}  // namespace
}  // namespace lacuna
