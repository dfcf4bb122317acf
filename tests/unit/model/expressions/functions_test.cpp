// SPDX-License-Identifier: MIT
#include "lacuna/model/expressions/functions.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

const Expression kFormulaX = Expression::variable("x"), kFormulaY = Expression::variable("y");

TEST(Functions, AreThoseOfTheLanguage) {
  const std::vector<std::pair<Expression, std::string>> all = {
      {sin(kFormulaX), "sin(x)"},
      {cos(kFormulaX), "cos(x)"},
      {tan(kFormulaX), "tan(x)"},
      {asin(kFormulaX), "asin(x)"},
      {acos(kFormulaX), "acos(x)"},
      {atan(kFormulaX), "atan(x)"},
      {tanh(kFormulaX), "tanh(x)"},
      {exp(kFormulaX), "exp(x)"},
      {log(kFormulaX), "log(x)"},
      {sqrt(kFormulaX), "sqrt(x)"},
      {abs(kFormulaX), "abs(x)"},
      {sign(kFormulaX), "sign(x)"},
      {step(kFormulaX), "step(x)"},
      {pow(kFormulaX, kFormulaY), "x^y"},
      {min(kFormulaX, kFormulaY), "min(x,y)"},
      {max(kFormulaX, 2), "max(x,2)"},
      {clip(kFormulaX, -1, kFormulaY), "clip(x,-1,y)"}};
  for (const auto& [expression, text] : all) {
    EXPECT_EQ(expression.to_string(), text);
    EXPECT_EQ(expression, parse_expression(text));
  }
}

TEST(Functions, NumbersAreFormulas) {
  EXPECT_EQ(2 * sin(kFormulaX) - kFormulaY / 4.0 + 1, parse_expression("2*sin(x)-y/4+1"));
  EXPECT_THROW(kFormulaX * std::numeric_limits<double>::infinity(), ModelError);
}

}  // namespace
}  // namespace lacuna
