// SPDX-License-Identifier: MIT
#include "model/equations/linear_terms.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

const Variables kDrivenSpace{.states = {"x", "y", "z"}, .inputs = {"u"}};

std::map<std::string, double> terms_of(const std::string& formula) {
  std::map<std::string, double> terms;
  for (const WeightedTerm& one :
       linear_terms(parse_summands(formula), VariableIndex(kDrivenSpace)))
    terms[one.term.name()] = one.coefficient;
  return terms;
}

using Terms = std::map<std::string, double>;

TEST(LinearTerms, NumbersInFrontOfATermAreItsCoefficient) {
  EXPECT_EQ(terms_of("-9.81/0.5*sin(x)"), (Terms{{"sin(x)", -19.62}}));
  EXPECT_EQ(terms_of("x/4 - (2*y)/(8*z)"), (Terms{{"x", 0.25}, {"y*z^-1", -0.25}}));
  EXPECT_EQ(terms_of("2*pi"), (Terms{{"1", 2.0 * 3.141592653589793}}));
  EXPECT_EQ(terms_of("sqrt(4)*u"), (Terms{{"u", 2.0}}));
}

TEST(LinearTerms, ProductsAreMultipliedOutOverSums) {
  EXPECT_EQ(terms_of("x*(28-z)-y"), (Terms{{"x", 28.0}, {"x*z", -1.0}, {"y", -1.0}}));
  EXPECT_EQ(terms_of("-10*(x-y)"), (Terms{{"x", -10.0}, {"y", 10.0}}));
  EXPECT_EQ(terms_of("(1+x)*(1-x)"), (Terms{{"1", 1.0}, {"x^2", -1.0}}));
}

TEST(LinearTerms, PowersDivisorsAndArgumentsStayAsTheyAre) {
  EXPECT_EQ(terms_of("(x-y)^2"), (Terms{{"(x-y)^2", 1.0}}));
  EXPECT_EQ(terms_of("3*(x+1)/(2+x)"), (Terms{{"x/(2+x)", 3.0}, {"1/(2+x)", 3.0}}));
  EXPECT_EQ(terms_of("2*sin(3*x+1)"), (Terms{{"sin(3*x+1)", 2.0}}));
}

TEST(LinearTerms, SumsToThePowerOfOneStayTogether) {
  EXPECT_EQ(terms_of("520*(x-y)^1 - x"), (Terms{{"x-y", 520.0}, {"x", -1.0}}));
  EXPECT_EQ(terms_of("u*(2*x-y)^1"), (Terms{{"u*(2*x-y)", 1.0}}));
  for (const char* term : {"x-y", "u*(2*x-y)", "(x+y)*(x-1)/(z+2)", "x^2*y", "sin(x-y)"}) {
    const Expression written = kept_together(parse_expression(term));
    EXPECT_EQ(terms_of(written.to_string()),
              (Terms{{Term::parse(term, kDrivenSpace).name(), 1.0}}))
        << written.to_string();
  }
}

/// u is a parameter here: a number in front of a bracket with it is one number.
TEST(LinearTerms, ProductsWithAParameterAreOneTerm) {
  const auto terms = [](const std::string& formula) {
    Terms found;
    for (const WeightedTerm& one :
         linear_terms(parse_summands(formula), VariableIndex(kDrivenSpace), {"u"}))
      found[one.term.name()] = one.coefficient;
    return found;
  };
  EXPECT_EQ(terms("-(x-u)/4"), (Terms{{"x-u", -0.25}}));
  EXPECT_EQ(terms("3*(x-y)/(2*u) + 2*(x-5)"),
            (Terms{{"(x-y)/u", 1.5}, {"x", 2.0}, {"1", -10.0}}));
  // A bracket with nothing but a sign in front has no number of its own.
  EXPECT_EQ(terms("-(2*x-u*y)"), (Terms{{"x", -2.0}, {"y*u", 1.0}}));
}

TEST(LinearTerms, ANumberThatIsWrittenIsANumberAlsoWhereItIsOne) {
  const auto fixed = [](const std::string& formula) {
    return linear_terms(parse_summands(formula), VariableIndex(kDrivenSpace)).front().fixed;
  };
  for (const char* formula : {"x", "-x", "+x*y", "-sin(x)/y"}) EXPECT_TRUE(fixed(formula));
  for (const char* formula : {"1*x", "-1.0*x", "x/1", "1.01*x", "1", "2*0.5*x*y"})
    EXPECT_FALSE(fixed(formula)) << formula;
}

TEST(LinearTerms, WhatIsThereTwiceIsJoinedAndWhatCancelsGoes) {
  EXPECT_EQ(terms_of("x*y + 2*y*x"), (Terms{{"x*y", 3.0}}));
  EXPECT_TRUE(terms_of("x - x").empty());
}

/// The sum has the value of the formula, wherever it is evaluated.
TEST(LinearTerms, HaveTheValueOfTheFormula) {
  const Expression formula =
      parse_expression("-(x-2*y)*(z/3+u*(1-x))/(1+y^2) + 4*exp(-x)*(y-1) - -z");
  std::vector<Expression> parts{formula};
  const Equation terms = linear_terms(std::vector{formula}, VariableIndex(kDrivenSpace));
  for (const WeightedTerm& one : terms) parts.push_back(one.term.expression());
  const Program program(parts, kDrivenSpace);
  Program::Workspace workspace;
  Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Vector slots(program.slots()), out(program.outputs());
    for (double& slot : slots) slot = random.normal();
    program.evaluate(slots.data(), out.data(), workspace);
    double sum = 0.0;
    for (std::size_t i = 0; i < terms.size(); ++i)
      sum += terms[i].coefficient * out[static_cast<Index>(i) + 1];
    EXPECT_NEAR(sum, out[0], 1e-12 * (1.0 + std::abs(out[0])));
  }
}

TEST(LinearTerms, RefusesWhatIsNoNumberAndWhatHasNoEnd) {
  EXPECT_THROW(terms_of("x/0"), ModelError);
  EXPECT_THROW(terms_of("x*q"), ModelError);
  std::string product = "(x+y+z+u)";
  for (int i = 0; i < 5; ++i) product += "*(x+y+z+u)";
  EXPECT_THROW(terms_of(product), ModelError);
}

}  // namespace
}  // namespace lacuna
