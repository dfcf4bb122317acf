// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "lacuna/model/expressions/expression.hpp"
#include "unit/model/expressions/random_expression.hpp"

namespace lacuna {
namespace {

TEST(PrintExpression, CanonicalTextIsAFixedPoint) {
  const std::vector<std::string> canonical{
      "x^2*y",    "sin(th)",      "-x*y",         "x*(y-1)",      "2*x^-1",
      "x^-y",     "-x^2",         "(-2)^2",       "(-x)^2",       "-(x+y)",
      "-(x*y)",   "x-(y-z)",      "x-y-z",        "x/(y*z)",      "x/y*z",
      "x^y^z",    "(x^y)^z",      "x*(-y)",       "x-(-2)",       "x+(-y*z)",
      "--x",      "max(x,-1)",    "clip(x,-1,1)", "delay(x,0.1)", "1e-300*x",
      "abs(x)*x", "(x*y)^0.5",    "x^(y+1)",      "sign(x-y)",    "x*(y*z)",
      "x^-2",     "x^(-y/z)",     "5e-324",       "1e+300*x",     "-2*x",
      "x^-y^2",   "min(x+1,y*z)", "tanh(x/0.02)", "(x+y)*(x-y)",  "exp(-x)"};
  for (const std::string& text : canonical) EXPECT_EQ(parse_expression(text).to_string(), text);
}

TEST(PrintExpression, DropsBlanksAndSuperfluousParentheses) {
  const std::vector<std::pair<std::string, std::string>> pairs{{" x ^ 2 * ( y ) ", "x^2*y"},
                                                               {"((x))", "x"},
                                                               {"(x*y)*z", "x*y*z"},
                                                               {"(x+y)+z", "x+y+z"},
                                                               {"x^(y^z)", "x^y^z"},
                                                               {"sin((x))", "sin(x)"},
                                                               {"+x", "x"},
                                                               {"x^(-1)", "x^-1"},
                                                               {"0.10", "0.1"},
                                                               {"x--2", "x-(-2)"},
                                                               {"-(-x)", "--x"},
                                                               {".5*x", "0.5*x"},
                                                               {"x\t+\n1", "x+1"},
                                                               {"- 2", "-2"},
                                                               {"(-x)*y", "-x*y"}};
  for (const auto& [written, printed] : pairs)
    EXPECT_EQ(parse_expression(written).to_string(), printed);
}

TEST(PrintExpression, ARowOfSignsReadsBack) {
  for (const std::size_t signs : {2u, 3u, 150u, 198u}) {
    const Expression e = parse_expression(std::string(signs, '-') + "x*y");
    EXPECT_EQ(parse_expression(e.to_string()), e) << signs;
  }
}

TEST(PrintExpression, WhatIsPrintedReadsBackTheSame) {
  Random random(20240611);
  for (int i = 0; i < 5000; ++i) {
    const Expression e = testing::random_expression(random, 1 + static_cast<int>(i % 7));
    const std::string text = e.to_string();
    ASSERT_EQ(parse_expression(text), e) << text;
    ASSERT_EQ(text.find(' '), std::string::npos);
  }
}

}  // namespace
}  // namespace lacuna
