// SPDX-License-Identifier: MIT
#include "model/export/dialect.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

std::string plain(const std::string& formula) {
  return code(parse_expression(formula), Dialect{.name = "test"});
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

TEST(Dialect, SaysHowNumbersTimeAndFunctionsAreWritten) {
  Dialect dialect{.name = "test", .time = "time", .power_sign = "**"};
  dialect.numbers_need_a_point = true;
  dialect.calls[Operation::Asin] = called("arcsin");
  dialect.variable = [](const std::string& name) { return "v(" + name + ")"; };
  const Expression formula = parse_expression("2*asin(x)+t^2+1e-5*max(x,lambda)");
  EXPECT_EQ(code(formula, dialect),
            "2.0*arcsin(v(x)) + time**2.0 + 1e-05*max(v(x), v(lambda))");
}

TEST(Dialect, WordsOfLanguagesGetAnUnderscore) {
  EXPECT_EQ(plain("lambda*x"), "lambda_*x");
  EXPECT_EQ(code_name("in", Dialect{}), "in_");
  EXPECT_EQ(code_name("inn", Dialect{}), "inn");
}

TEST(Dialect, RefusesDelaysThatItDoesNotHave) {
  EXPECT_THROW(plain("delay(x,0.5)"), ModelError);
  EXPECT_EQ(code(parse_expression("delay(x,0.5)"), Dialect{.name = "test", .has_delay = true}),
            "delay(x, 0.5)");
}

}  // namespace
}  // namespace lacuna
