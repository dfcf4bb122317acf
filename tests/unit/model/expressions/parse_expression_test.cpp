// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/term.hpp"
#include "lacuna/model/expressions/expression.hpp"
#include "unit/model/expressions/random_expression.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kKnown{"x", "y", "theta", "t"};

std::string parse_message(const std::string& text) {
  try {
    parse_expression(text, kKnown);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ParseExpression, PowerBindsTightestAndToTheRightThenTheSign) {
  const auto number = [](double v) { return Expression::number(v); };
  const Expression x = Expression::variable("x");
  const Expression square = Expression::make(Operation::Power, {x, number(2.0)});
  EXPECT_EQ(parse_expression("-x^2"), -square);
  EXPECT_EQ(parse_expression("2*-x^2"), number(2.0) * -square);
  EXPECT_EQ(parse_expression("x^2^x"),
            Expression::make(Operation::Power,
                             {x, Expression::make(Operation::Power, {number(2.0), x})}));
  EXPECT_EQ(parse_expression("x-x-x"), (x - x) - x);
  EXPECT_EQ(parse_expression("-x*x"), (-x) * x);
}

TEST(ParseExpression, PiIsANumber) {
  EXPECT_EQ(parse_expression("pi"), Expression::number(std::numbers::pi));
  EXPECT_EQ(parse_expression("sin(2*pi*50*t+3.66519143)", kKnown).variables(),
            std::set<std::string>{"t"});
}

TEST(ParseExpression, DelayOfAFormulaIsTheFormulaOfDelayedVariables) {
  EXPECT_EQ(parse_expression("delay(x*y,0.1)"),
            Expression::delayed("x", 0.1) * Expression::delayed("y", 0.1));
  EXPECT_EQ(parse_expression("delay(delay(x,1),2)"), Expression::delayed("x", 3.0));
  EXPECT_EQ(parse_expression("delay(x,2*pi/4)"),
            Expression::delayed("x", 2.0 * std::numbers::pi / 4.0));
  EXPECT_EQ(parse_expression("delay(x,0)"), Expression::variable("x"));
  EXPECT_EQ(parse_expression("delay(sin(t),1)").to_string(), "sin(t-1)");
}

TEST(ParseExpression, ErrorsNameTheColumnAndTheRemedy) {
  EXPECT_EQ(parse_message("x*q"),
            "term 'x*q', column 3: unknown name 'q'; known are: x, y, theta, t");
  EXPECT_THAT(parse_message("x*thete"),
              HasSubstr("column 3: unknown name 'thete'; did you mean 'theta'"));
  EXPECT_THAT(parse_message("sine(x)"),
              HasSubstr("column 1: unknown function 'sine'; did you mean 'sin'"));
  EXPECT_THAT(parse_message("1+max(x)"), HasSubstr("column 3: 'max' has 1 arguments, not 2"));
  EXPECT_THAT(parse_message("sin()"), HasSubstr("column 1: 'sin' has 0 arguments, not 1"));
  EXPECT_THAT(parse_message("x*(y"), HasSubstr("column 3: '(' without ')'"));
  EXPECT_THAT(parse_message("sin(x"), HasSubstr("column 4: '(' without ')'"));
  EXPECT_THAT(parse_message("x)"), HasSubstr("column 2: ')' without '('"));
  EXPECT_THAT(parse_message("x**2"),
              HasSubstr("column 3: '*' where a value should stand; powers"));
  EXPECT_THAT(parse_message("x(t-1)"), HasSubstr("column 1: 'x' is not a function"));
  EXPECT_THAT(parse_message("2 x"), HasSubstr("column 3: an operator is missing before 'x'"));
  EXPECT_THAT(parse_message("sin"), HasSubstr("column 1: the function 'sin' has no arguments"));
  EXPECT_THAT(parse_message("x+"), HasSubstr("column 3: the formula ends too early"));
  EXPECT_THAT(parse_message(""), HasSubstr("column 1: the formula is empty"));
  EXPECT_THAT(parse_message("x$y"), HasSubstr("column 2: unexpected '$'"));
  EXPECT_THAT(parse_message("x\x01y"), HasSubstr("column 2: unexpected byte 0x01"));
}

TEST(ParseExpression, NumbersOutOfRangeAndBadDelays) {
  EXPECT_THAT(parse_message("x*1e999"), HasSubstr("column 3: the number is out of the range"));
  EXPECT_THAT(parse_message("delay(x,-1)"), HasSubstr("column 9: the delay -1 is not"));
  const std::vector<std::string> names{"x", "y"};
  EXPECT_THROW(parse_expression("delay(x,y)", names), ModelError);
  EXPECT_THAT(parse_message("delay(x,1/0)"), HasSubstr("column 9: the delay inf is not"));
  EXPECT_THAT(parse_message("delay(x)"), HasSubstr("column 1: 'delay' has 1 arguments, not 2"));
}

TEST(ParseExpression, MessagesAreOneShortLine) {
  const std::string text = parse_message(std::string(500, 'x') + "\n" + std::string(500, 'y'));
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_LT(parse_message("x+" + std::string(500, '(') + "\n").size(), 300u);
}

TEST(ParseExpression, DeepNestingIsAnErrorNotACrash) {
  const auto nested = [](std::size_t n, const std::string& open, const std::string& close) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i) text += open;
    text += "x";
    for (std::size_t i = 0; i < n; ++i) text += close;
    return text;
  };
  for (const std::string open : {"(", "sin(", "abs((", "-(", "max(x,"})
    EXPECT_THAT(parse_message(nested(100000, open, ")")),
                HasSubstr("nested deeper than 200 levels"));
  for (const std::string open : {"-", "x^", "+"})
    EXPECT_THAT(parse_message(nested(100000, open, "")),
                HasSubstr("nested deeper than 200 levels"));
  EXPECT_THAT(parse_message(nested(100000, "x+", "")),
              HasSubstr("more than 400 operations deep"));
  EXPECT_EQ(parse_expression(nested(199, "(", ")")), Expression::variable("x"));
  EXPECT_EQ(parse_expression(nested(300, "x*", "")).depth(), 300);
}

TEST(ParseExpression, GarbageIsAnErrorOrAFormula) {
  const std::vector<std::string> pieces{
      "x",    "y",      "(", ")",     "sin(", "max(",   ",",   "+",  "-", "*",
      "/",    "^",      "1", "e",     ".",    "2.5e-3", " ",   "pi", "$", "\n",
      "\xff", "delay(", "t", "1e999", "0",    "abs",    "inf", "#"};
  Random random(5);
  int formulas = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (std::uint64_t n = random.below(12); n-- > 0;)
      text += pieces[random.below(pieces.size())];
    try {
      const Expression e = parse_expression(text, kKnown);
      ASSERT_EQ(parse_expression(e.to_string(), kKnown), e) << text;
      ++formulas;
    } catch (const ModelError& error) {
      ASSERT_THAT(std::string(error.where()), HasSubstr("column"));
    }
  }
  EXPECT_GT(formulas, 100);
}

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

const Variables kSpace{{"x", "y", "z"}, {}};

Index operations(const std::vector<std::string>& formulas) {
  std::vector<Expression> expressions;
  for (const std::string& formula : formulas) expressions.push_back(parse_expression(formula));
  return Program(expressions, kSpace).operations();
}

TEST(ProgramBuilder, IntegerPowersAreProducts) {
  EXPECT_EQ(operations({"x^2"}), 1);
  EXPECT_EQ(operations({"x^2*y*z"}), 3);
  EXPECT_EQ(operations({"x^2*y*z", "x^2*y", "x^2", "x", "1"}), 3);
  EXPECT_EQ(operations({"x^5", "x^4", "x^3", "x^2"}), 4);
  EXPECT_LE(operations({"x^64"}), 20);
  EXPECT_EQ(operations({"x^-1"}), 1);
  EXPECT_EQ(operations({"x^-2", "x^2"}), 2);
}

TEST(ProgramBuilder, EverythingIsComputedOnce) {
  EXPECT_EQ(operations({"sin(x*y)", "cos(y*x)", "exp(-(x*y))"}), 5);
  EXPECT_EQ(operations({"x+y", "y+x"}), 1);
  EXPECT_EQ(operations({"x-y", "y-x"}), 2);
  EXPECT_EQ(operations({"delay(x,1)*y", "y*delay(x,1)"}), 1);
}

TEST(ProgramBuilder, ConstantsAreFolded) {
  EXPECT_EQ(operations({"2*pi*50"}), 0);
  EXPECT_EQ(operations({"sin(2*pi*50*t+3.66519143)"}), 3);
  EXPECT_EQ(operations({"clip(3,0,1)+x"}), 1);
}

TEST(ProgramBuilder, AMonomialLibraryIsOneProductPerTerm) {
  TermLibrary library{kSpace, {}};
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; i + j <= 5; ++j)
      for (int k = 0; i + j + k <= 5; ++k)
        library.terms.push_back(Term::monomial({i, j, k, 0}, kSpace));
  EXPECT_EQ(library.size(), 56);
  EXPECT_EQ(library.compile().operations(), 56 - 4);
}

}  // namespace
}  // namespace lacuna
