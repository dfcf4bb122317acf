// SPDX-License-Identifier: MIT
#include "lacuna/model/expressions/expression.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/expressions/program.hpp"
#include "model/expressions/domain.hpp"
#include "unit/model/expressions/random_expression.hpp"

namespace lacuna {
namespace {

const Expression kX = Expression::variable("x");
const Expression kY = Expression::variable("y");

TEST(Expression, OperatorsKeepWhatWasWritten) {
  const Expression e = kX * kX + kY / kX - (-kY);
  EXPECT_EQ(e.operation(), Operation::Subtract);
  EXPECT_EQ(e.operands()[1].operation(), Operation::Negate);
  EXPECT_EQ(e.operands()[0].operands()[0], kX * kX);
  EXPECT_EQ(e.depth(), 3);
}

TEST(Expression, SignInFrontOfANumberIsFolded) {
  EXPECT_EQ(-Expression::number(2.0), Expression::number(-2.0));
  EXPECT_EQ((-Expression::number(2.0)).operation(), Operation::Number);
}

TEST(Expression, EqualityIsStructure) {
  EXPECT_EQ(kX * kY, kX * kY);
  EXPECT_NE(kX * kY, kY * kX);
  EXPECT_NE(kX + kY, kX * kY);
  EXPECT_NE(Expression::number(0.1), Expression::number(0.1 + 1e-17 + 2e-17));
  EXPECT_NE(Expression::delayed("x", 1.0), Expression::delayed("x", 2.0));
  EXPECT_NE(Expression::delayed("x", 1.0), kX);
  EXPECT_EQ((kX * kY).hash(), (kX * kY).hash());
}

TEST(Expression, VariablesAreAllNames) {
  const Expression e = kX * Expression::delayed("u", 1.0) + Expression::number(3.0);
  EXPECT_EQ(e.variables(), (std::set<std::string>{"u", "x"}));
}

TEST(Expression, DelayOfTimeAndDelayOfNothing) {
  EXPECT_EQ(Expression::delayed("t", 2.0), Expression::variable("t") - Expression::number(2.0));
  EXPECT_EQ(Expression::delayed("x", 0.0), kX);
}

TEST(Expression, RejectsWhatIsNoExpression) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Expression::number(kInfinity), ModelError);
  EXPECT_THROW(Expression::number(std::numeric_limits<double>::quiet_NaN()), ModelError);
  EXPECT_THROW(Expression::variable("2x"), ModelError);
  EXPECT_THROW(Expression::variable(""), ModelError);
  EXPECT_THROW(Expression::variable("x y"), ModelError);
  EXPECT_THROW(Expression::variable("sin"), ModelError);
  EXPECT_THROW(Expression::variable("pi"), ModelError);
  EXPECT_THROW(Expression::delayed("x", -1.0), ModelError);
  EXPECT_THROW(Expression::delayed("x", kInfinity), ModelError);
}

TEST(Expression, RejectsWrongNumberOfOperands) {
  EXPECT_THROW(Expression::make(Operation::Sin, {}), ModelError);
  EXPECT_THROW(Expression::make(Operation::Add, {kX}), ModelError);
  EXPECT_THROW(Expression::make(Operation::Clip, {kX, kX}), ModelError);
  EXPECT_THROW(Expression::make(Operation::Variable, {}), ModelError);
  EXPECT_THROW(Expression::make(Operation::Delay, {kX, kY}), ModelError);
}

TEST(Expression, DepthIsBoundedAndTheDeepestTreeIsFreed) {
  Expression deep = kX;
  for (int i = 0; i < kMaxExpressionDepth; ++i) deep = deep + kX;
  EXPECT_EQ(deep.depth(), kMaxExpressionDepth);
  EXPECT_FALSE(deep.to_string().empty());
  EXPECT_THROW(deep + kX, ModelError);
}

TEST(Expression, RandomTreesEqualThemselvesOnly) {
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    Random replay = random;
    const Expression e = testing::random_expression(random, 4);
    EXPECT_EQ(e, testing::random_expression(replay, 4));
    EXPECT_NE(e, e + kX);
  }
}

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

double value_at(const Expression& formula, double x) {
  const Program program(std::vector{formula}, Variables{{"x"}, {"n"}});
  const std::array<double, 3> slots{x, 0.4, 0.0};
  Program::Workspace workspace;
  double value = 0.0;
  program.evaluate(slots.data(), &value, workspace);
  return value;
}

struct Edge {
  const char* formula;
  double inside, edge, outside;
};

TEST(Domain, FunctionsGoOnAsTheyAreAtTheirEdge) {
  for (const Edge& one : {Edge{"3*sqrt(x)", 0.25, 0.0, -0.1},
                          {"x^0.7", 0.25, 0.0, -2.0},
                          {"x*log(x)", 0.25, 0.0, 0.0},
                          {"asin(x)", 0.25, 1.0, 1.5},
                          {"acos(x/2)", 0.25, -2.0, -2.5},
                          {"sqrt(4-x)", 0.25, 4.0, 9.0},
                          {"x^n", 0.25, 0.0, -1.0},
                          {"x^(1/3)", 0.5, 0.0, -1.0}}) {
    const Expression formula = parse_expression(one.formula), held = held_in_domain(formula),
                     sloped = held_off_edges(formula);
    EXPECT_EQ(value_at(held, one.inside), value_at(formula, one.inside)) << one.formula;
    EXPECT_EQ(value_at(differentiate(sloped, "x"), one.inside),
              value_at(differentiate(formula, "x"), one.inside))
        << one.formula;
    const double edge =
        std::isnan(value_at(formula, one.edge)) ? 0.0 : value_at(formula, one.edge);
    EXPECT_EQ(value_at(held, one.edge), edge) << one.formula;
    EXPECT_EQ(value_at(held, one.outside), edge) << one.formula;
    for (const double x : {one.edge, one.outside})
      for (const char* by : {"x", "n"})
        EXPECT_TRUE(std::isfinite(value_at(differentiate(sloped, by), x)))
            << one.formula << " by " << by << " at " << x;
  }
}

TEST(Domain, WhatIsDefinedEverywhereStaysAsItIs) {
  for (const char* text : {"x^2-1/x", "x^-3", "exp(sin(x))*abs(x)", "sqrt(2)*x"}) {
    const Expression formula = parse_expression(text);
    EXPECT_EQ(held_in_domain(formula), formula) << text;
    EXPECT_EQ(held_off_edges(formula), formula) << text;
    EXPECT_TRUE(domain_margins(formula).empty()) << text;
  }
}

TEST(Domain, MarginsAreBelowZeroWhereAFunctionIsNotDefined) {
  const std::vector<Expression> margins =
      domain_margins(parse_expression("x*sqrt(x-3) + asin(n) - log(2*x)^2"));
  std::vector<std::string> texts;
  for (const Expression& margin : margins) texts.push_back(margin.to_string());
  EXPECT_THAT(texts, ::testing::UnorderedElementsAre("x-3", "n+1", "1-n", "2*x"));
}

}  // namespace
}  // namespace lacuna
