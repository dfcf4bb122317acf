// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lacuna/model/expressions/program.hpp"

namespace lacuna {
namespace {

double value(const std::string& formula, double x = 0.0) {
  const Expression expression = parse_expression(formula);
  const Program program({&expression, 1}, {{"x"}, {}});
  Program::Workspace workspace;
  const double slots[2] = {x, 0.0};
  double result = 0.0;
  program.evaluate(slots, &result, workspace);
  return result;
}

TEST(Operations, SignStepAndClipAtTheirKinks) {
  EXPECT_EQ(value("sign(x)", 0.0), 0.0);
  EXPECT_EQ(value("sign(x)", -3.0), -1.0);
  EXPECT_EQ(value("sign(x)", 1e-300), 1.0);
  EXPECT_EQ(value("step(x)", 0.0), 1.0);
  EXPECT_EQ(value("step(x)", -1e-300), 0.0);
  EXPECT_EQ(value("clip(x,-1,2)", 5.0), 2.0);
  EXPECT_EQ(value("clip(x,-1,2)", -5.0), -1.0);
  EXPECT_EQ(value("clip(x,-1,2)", 0.5), 0.5);
  EXPECT_EQ(value("clip(x,2,-1)", 0.5), -1.0);
}

TEST(Operations, FunctionsAreThoseOfTheirNames) {
  EXPECT_EQ(value("sin(x)", 0.3), std::sin(0.3));
  EXPECT_EQ(value("cos(x)", 0.3), std::cos(0.3));
  EXPECT_EQ(value("tan(x)", 0.3), std::tan(0.3));
  EXPECT_EQ(value("asin(x)", 0.3), std::asin(0.3));
  EXPECT_EQ(value("acos(x)", 0.3), std::acos(0.3));
  EXPECT_EQ(value("atan(x)", 0.3), std::atan(0.3));
  EXPECT_EQ(value("tanh(x)", 0.3), std::tanh(0.3));
  EXPECT_EQ(value("exp(x)", 0.3), std::exp(0.3));
  EXPECT_EQ(value("log(x)", 0.3), std::log(0.3));
  EXPECT_EQ(value("sqrt(x)", 0.3), std::sqrt(0.3));
  EXPECT_EQ(value("abs(x)", -0.3), 0.3);
  EXPECT_EQ(value("min(x,1)", 3.0), 1.0);
  EXPECT_EQ(value("max(x,1)", 3.0), 3.0);
  EXPECT_EQ(value("2-x/4", 3.0), 1.25);
}

TEST(Operations, PowersOfEveryKind) {
  EXPECT_EQ(value("x^3", 3.0), 27.0);
  EXPECT_EQ(value("x^-2", 4.0), 1.0 / 16.0);
  EXPECT_EQ(value("x^0", 4.0), 1.0);
  EXPECT_EQ(value("x^0.5", 4.0), 2.0);
  EXPECT_EQ(value("x^x", 3.0), 27.0);
  EXPECT_EQ(value("2^x", 10.0), 1024.0);
  EXPECT_EQ(value("x^40", 2.0), std::pow(2.0, 40));
  EXPECT_EQ(value("x^5000", 1.0), 1.0);
  EXPECT_EQ(value("(-x)^3", 2.0), -8.0);
}

TEST(Operations, OutsideTheDomainIsNotANumberNotAnException) {
  for (const char* formula : {"log(x)", "sqrt(x)", "asin(x)", "acos(x)", "x^0.5", "x^0.3"})
    EXPECT_TRUE(std::isnan(value(formula, -2.0))) << formula;
  EXPECT_TRUE(std::isinf(value("1/x", 0.0)));
  EXPECT_TRUE(std::isnan(value("log(-1)")));
}

TEST(Operations, NotANumberGoesThroughEveryFunction) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const char* formula : {"min(x,1)", "min(1,x)", "max(x,1)", "max(1,x)", "clip(x,0,1)",
                              "sign(x)", "step(x)", "abs(x)", "tanh(x)", "-x", "x^2"})
    EXPECT_TRUE(std::isnan(value(formula, kNan))) << formula;
}

}  // namespace
}  // namespace lacuna
