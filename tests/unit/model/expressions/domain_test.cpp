// SPDX-License-Identifier: MIT
#include "model/expressions/domain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lacuna/model/expressions/program.hpp"

namespace lacuna {
namespace {

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
